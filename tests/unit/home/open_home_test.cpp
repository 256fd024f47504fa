#include "home/open_home.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace roomlight::home
