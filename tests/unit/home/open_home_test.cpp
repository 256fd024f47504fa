#include "home/open_home.h"

#include <gtest/gtest.h>

#include <cmath>

#include "import/lighting_file.h"
#include "support/furnished.h"
#include "unit/temporary_folder.h"

namespace roomlight::home {
namespace {

using testing::TemporaryFolder;

std::string objOf(const Scene& scene, float scale = 1) {
  std::string text;
  size_t first = 1;
  for (const Instance& instance : scene.instances) {
    const Mesh& mesh = scene.meshes[static_cast<size_t>(instance.mesh)];
    text += fmt::format("o {}\n", instance.name);
    for (const Vec3 p : mesh.positions) {
      const Vec3 q = instance.worldFromObject.point(p) * scale;
      text += fmt::format("v {} {} {}\n", q.x, q.y, q.z);
    }
    for (size_t i = 0; i + 2 < mesh.indices.size(); i += 3)
      text += fmt::format("f {} {} {}\n", first + mesh.indices[i], first + mesh.indices[i + 1],
                          first + mesh.indices[i + 2]);
    first += mesh.positions.size();
  }
  return text;
}

// The same as glTF with a camera that looks so far down from above the room, in degrees.
void writeGltf(const TemporaryFolder& folder, const Scene& scene, float downDeg) {
  nlohmann::json j = {{"asset", {{"version", "2.0"}}}, {"scene", 0}};
  std::string bytes;
  const auto view = [&](const auto& values) {
    j["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", bytes.size()}, {"byteLength", values.size() * 4}});
    bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * 4);
    return j["bufferViews"].size() - 1;
  };
  for (const Instance& instance : scene.instances) {
    const Mesh& mesh = scene.meshes[static_cast<size_t>(instance.mesh)];
    std::vector<float> places;
    Bounds3 b;
    for (const Vec3 p : mesh.positions) {
      const Vec3 q = instance.worldFromObject.point(p);
      places.insert(places.end(), {q.x, q.y, q.z}), b.add(q);
    }
    const size_t first = j["accessors"].size();
    j["accessors"].push_back({{"bufferView", view(places)},
                              {"componentType", 5126},
                              {"count", mesh.positions.size()},
                              {"type", "VEC3"},
                              {"min", {b.lo.x, b.lo.y, b.lo.z}},
                              {"max", {b.hi.x, b.hi.y, b.hi.z}}});
    j["accessors"].push_back({{"bufferView", view(mesh.indices)},
                              {"componentType", 5125},
                              {"count", mesh.indices.size()},
                              {"type", "SCALAR"}});
    j["nodes"].push_back({{"mesh", j["meshes"].size()}});
    j["meshes"].push_back({{"primitives", {{{"attributes", {{"POSITION", first}}}, {"indices", first + 1}}}}});
  }
  const float a = downDeg * kPi / 180, c = std::cos(a), s = std::sin(a);
  // Looks along (0, -s, -c) at the middle of the room from 12 m away.
  j["nodes"].push_back({{"name", "Above"},
                        {"camera", 0},
                        {"matrix", {1, 0, 0, 0, 0, c, -s, 0, 0, s, c, 0, 2.5, 1 + 12 * s, 2 + 12 * c, 1}}});
  j["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 0.6}, {"znear", 0.1}}}}};
  nlohmann::json all = nlohmann::json::array();
  for (size_t i = 0; i < j["nodes"].size(); ++i) all.push_back(i);
  j["scenes"] = {{{"nodes", all}}};
  j["buffers"] = {{{"uri", "room.bin"}, {"byteLength", bytes.size()}}};
  testing::writeFile(folder / "room.bin", bytes);
  testing::writeFile(folder / "room.gltf", j.dump());
}

class OpenHome : public ::testing::Test {
 protected:
  OpenedHome open(OpenWish wish = {}) {
    wish.scene = folder_ / "room.obj";
    Result<OpenedHome> home = openHome(wish);
    EXPECT_TRUE(home) << home.error();
    return home ? std::move(home.value()) : OpenedHome();
  }
  void write(const Scene& scene, float scale = 1) { testing::writeFile(folder_ / "room.obj", objOf(scene, scale)); }
  TemporaryFolder folder_;
};

TEST_F(OpenHome, aRoomWithNothingGetsLightAndCameras) {
  write(test::furnishedRoom());
  const OpenedHome home = open();
  EXPECT_EQ(home.fileCameras, 0u);
  EXPECT_EQ(defaultCamera(home.scene).name, "Room 1");
  EXPECT_FALSE(home.lighting.is_null());
  EXPECT_EQ(home.scene.suns.size(), 1u);
  EXPECT_EQ(home.scene.rooms.size(), 1u);
  ASSERT_FALSE(home.notes.empty());
  EXPECT_NE(home.notes.back().find("added daylight and a ceiling lamp"), std::string::npos) << home.notes.back();
}

TEST_F(OpenHome, inMillimetresIsTheSameRoom) {
  write(test::furnishedRoom());
  const OpenedHome metres = open();
  write(test::furnishedRoom(), 1000);
  const OpenedHome millimetres = open();
  EXPECT_EQ(millimetres.metresPerUnit, 0.001);
  EXPECT_NE(millimetres.notes.front().find("taken as millimetres"), std::string::npos);
  EXPECT_NEAR(
      length(defaultCamera(metres.scene).worldFromCamera.w - defaultCamera(millimetres.scene).worldFromCamera.w), 0,
      0.01);
  EXPECT_EQ(metres.lighting["daylight"], millimetres.lighting["daylight"]);
  OpenWish wish;
  wish.metresPerUnit = 0.01f;
  EXPECT_NEAR(open(wish).scene.bounds().size().x, 54, 0.1);
}

// What measures, lists and names lamps by rooms knows the same ones.
TEST_F(OpenHome, roomsAreThoseOfTheScene) {
  write(test::furnishedRoom());
  const OpenedHome home = open();
  ASSERT_EQ(home.scene.rooms.size(), 1u);
  EXPECT_EQ(home.scene.rooms[0].name, "Room 1");
}

TEST_F(OpenHome, lightIsAsWished) {
  write(test::furnishedRoom());
  OpenWish wish;
  wish.light = LightWish::File;
  EXPECT_TRUE(open(wish).scene.suns.empty());
  EXPECT_EQ(open(wish).warnings.size(), 1u);
  wish.light = LightWish::Evening;
  EXPECT_EQ(open(wish).scene.lamps.size(), 1u);
  EXPECT_TRUE(lightWishFromName("evening"));
  EXPECT_FALSE(lightWishFromName("dawn"));
}

TEST_F(OpenHome, aLightingFileIsLightOfItsOwn) {
  write(test::furnishedRoom());
  testing::writeFile(folder_ / "lamp.json",
                     R"({"lamps": [{"type": "point", "position": [2, 2, 2], "flux": "800 lm"}]})");
  OpenWish wish;
  wish.lighting = folder_ / "lamp.json";
  const OpenedHome home = open(wish);
  EXPECT_TRUE(home.lighting.is_null());
  EXPECT_TRUE(home.scene.suns.empty());
  EXPECT_EQ(home.scene.lamps.size(), 1u);
}

// Who switches everything off wants it dark.
TEST_F(OpenHome, aLightingFileMayLeaveItDark) {
  write(test::furnishedRoom());
  testing::writeFile(folder_ / "dark.json", R"({"scene": {"lamps": "off"}})");
  OpenWish wish;
  wish.lighting = folder_ / "dark.json";
  const OpenedHome home = open(wish);
  EXPECT_TRUE(home.lighting.is_null());
  EXPECT_EQ(home.warnings.size(), 1u);
  testing::writeFile(folder_ / "ground.json", R"({"ground": {"elevation": -0.3, "radius": 50}})");
  wish.lighting = folder_ / "ground.json";
  EXPECT_FALSE(open(wish).lighting.is_null());
}

// What was added makes the same scene when it is given as a file.
TEST_F(OpenHome, addedLightIsALightingFile) {
  write(test::furnishedRoom());
  const OpenedHome home = open();
  testing::writeFile(folder_ / "day.json", home.lighting.dump(2));
  OpenWish wish;
  wish.lighting = folder_ / "day.json";
  const OpenedHome again = open(wish);
  EXPECT_TRUE(again.lighting.is_null());
  ASSERT_EQ(again.scene.suns.size(), 1u);
  EXPECT_TRUE(again.scene.suns[0].toLight == home.scene.suns[0].toLight);
  EXPECT_EQ(again.scene.instances.size(), home.scene.instances.size());
}

TEST_F(OpenHome, isCutOpenForCamerasThatLookDownAtIt) {
  OpenWish wish;
  wish.scene = folder_ / "room.gltf";
  wish.allCameras = true;
  const auto cutOf = [&](float downDeg, size_t& others) {
    writeGltf(folder_, test::furnishedRoom(), downDeg);
    const Result<OpenedHome> home = openHome(wish);
    if (!home) ADD_FAILURE() << home.error();
    if (!home || home.value().fileCameras != 1) return 0.0f;
    const std::vector<Camera>& cameras = home.value().scene.cameras;
    others = 0;
    for (size_t i = 1; i < cameras.size(); ++i)
      others += cameras[i].projection == Projection::Perspective && cameras[i].cutHeightM < kInfinity;
    EXPECT_NE(home.value().scene.cameraInUse, 0) << "what is shown by default is as ever: it stands outside";
    return cameras[0].cutHeightM;
  };
  size_t others = 0;
  const float steep = cutOf(60, others);
  EXPECT_GT(steep, 1.1f);
  EXPECT_LT(steep, 2.58f);
  EXPECT_EQ(others, 0u) << "proposals are not cut";
  EXPECT_EQ(cutOf(10, others), kInfinity);
}

}  // namespace
}  // namespace roomlight::home
