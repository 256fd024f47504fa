// Walk files: what is read, and what is refused.
#include "import/walk_file.h"

#include <gtest/gtest.h>

#include "support/rooms.h"
#include "unit/temporary_folder.h"

namespace roomlight {
namespace {

// A floor, two chairs and a lamp of each kind.
Scene home() {
  Scene scene;
  const int grey = test::addMaterial(scene, test::lambertian(0.5f)),
            shining = test::addMaterial(scene, test::lambertian(0, 100));
  test::addRectangle(scene, {0, 0, 0}, {0, 0, 4}, {4, 0, 0}, grey);
  for (const float x : {1.0f, 2.0f}) {
    const size_t first = scene.instances.size();
    test::addBox(scene, {x, 0, 1}, {x + 0.5f, 1, 1.5f}, grey);
    for (size_t i = first; i < scene.instances.size(); ++i)
      scene.instances[i].name = "Chair", scene.instances[i].object = scene.instances[first].object;
  }
  test::addRectangle(scene, {0, 2, 0}, {1, 0, 0}, {0, 0, 1}, shining);
  scene.instances.back().name = "Bulb (light)";
  scene.lamps = {test::pointLamp({2, 2, 2}, 100)};
  scene.lamps[0].name = "Pendant";
  return scene;
}

class WalkFile : public ::testing::Test {
 protected:
  testing::TemporaryFolder folder_;
  Scene scene_ = home();

  Result<Walk> read(const std::string& json) {
    testing::writeFile(folder_ / "walk.json", json);
    return readWalkFile(folder_ / "walk.json", scene_);
  }
  Walk good() {
    Result<Walk> walk = read(R"({"version": 1, "seconds": 2, "framesPerSecond": 5,
      "camera": [{"time": 0, "position": [0, 1.6, 3], "target": [1, 1, 1], "verticalFov": 60}, {"time": 2, "position": [2, 1.6, 3], "target": [1, 1, 1], "verticalFov": 60}],
      "objects": [{"name": "Chair", "number": 2, "keys": [{"time": 0}, {"time": 1, "move": [0.5, 0, 0], "turn": 90}, {"time": 2}]}],
      "lamps": [{"name": "Bulb", "keys": [{"time": 0, "dimming": 1}, {"time": 1, "dimming": 0.25}]}, {"name": "Pendant", "keys": [{"time": 0, "dimming": 0.5}]}]})");
    EXPECT_TRUE(walk.ok()) << walk.error();
    return walk.value();
  }
  void expectError(const std::string& json, const std::string& part) {
    const Result<Walk> walk = read(json);
    ASSERT_FALSE(walk.ok());
    EXPECT_NE(walk.error().find(part), std::string::npos) << walk.error();
    EXPECT_NE(walk.error().find("walk.json"), std::string::npos);
  }
  void expectErrorOf(const std::string& entries, const std::string& part) {
    expectError(
        R"({"seconds": 2, "camera": [{"time": 0, "position": [0, 1, 0], "target": [1, 1, 1]}], )" + entries + "}",
        part);
  }
};

TEST_F(WalkFile, thingsAndLampsAnswerToWhatPeopleCallThem) {
  for (Instance& i : scene_.instances) {
    if (i.name == "Chair") i.label = "Wall, Kitchen, north", i.name = "wall-0-15";
  }
  scene_.lamps[0].name = "Pendant.001";
  for (const auto& [thing, lamp] : {std::pair{"wall-0-15", "Pendant.001"}, {"Wall, Kitchen, north", "Pendant"}}) {
    const Result<Walk> walk = read(std::string(R"({"version": 1, "seconds": 2, "framesPerSecond": 5,
          "camera": [{"time": 0, "position": [0, 1.6, 3], "target": [1, 1, 1]}],
          "objects": [{"name": ")") +
                                   thing + R"(", "number": 2, "keys": [{"time": 0}, {"time": 1, "turn": 90}]}],
          "lamps": [{"name": ")" + lamp +
                                   R"(", "keys": [{"time": 0, "dimming": 0.5}]}]})");
    ASSERT_TRUE(walk.ok()) << walk.error();
    EXPECT_EQ(walk.value().lamps.at(0).lamps.size(), 1u);
    EXPECT_FALSE(walk.value().things.at(0).instances.empty());
  }
}

TEST_F(WalkFile, cameraGoesFromKeyToKey) {
  const Walk walk = good();
  EXPECT_EQ(walk.frameCount(), 10);
  EXPECT_DOUBLE_EQ(walk.timeOf(5), 1);
  const Camera middle = cameraAt(walk, 1);
  EXPECT_NEAR(middle.worldFromCamera.w.x, 1, 1e-5);
  EXPECT_NEAR(middle.worldFromCamera.z.z, 2 / std::sqrt(4 + 0.36f), 1e-5);  // looks along -z, a little down
  EXPECT_NEAR(middle.yFovRad, kPi / 3, 1e-5);
  EXPECT_EQ(cameraAt(walk, 9).worldFromCamera.w, Vec3(2, 1.6f, 3));
}

TEST_F(WalkFile, thingsMoveAboutTheirMiddleAndComeBack) {
  const Walk walk = good();
  const Scene before = scene_;
  const SceneChange change = stage(walk, 1, scene_);
  EXPECT_EQ(change.moved.size(), 6u);
  Bounds3 now;
  for (const uint32_t i : change.moved) now.add(instanceBounds(scene_, scene_.instances[i]));
  EXPECT_NEAR(now.centre().x, 2.75f, 1e-5);  // a square chair, turned by a right angle: as wide as before
  EXPECT_NEAR(now.size().x, 0.5f, 1e-5);
  EXPECT_TRUE(stage(walk, 1, scene_).moved.empty());
  stage(walk, 2, scene_);
  for (size_t i = 0; i < scene_.instances.size(); ++i)
    EXPECT_EQ(scene_.instances[i].worldFromObject.w, before.instances[i].worldFromObject.w);
}

TEST_F(WalkFile, lampsAreDimmed) {
  const Walk walk = good();
  const SceneChange change = stage(walk, 1, scene_);
  EXPECT_TRUE(change.lamps);
  EXPECT_EQ(change.glow.size(), 1u);
  EXPECT_FLOAT_EQ(scene_.lamps[0].intensityCd.x, 50);
  EXPECT_FLOAT_EQ(scene_.materials[1].emission.x, 25);
  atRest(walk, scene_);
  EXPECT_FLOAT_EQ(scene_.lamps[0].intensityCd.x, 100);
  EXPECT_FLOAT_EQ(scene_.materials[1].emission.x, 100);
}

TEST_F(WalkFile, betweenKeysNothingOvershoots) {
  const WalkTrack track{{0, 1, 1.2, 3}, {{0, 0, 5, 5}}};
  for (int i = 0; i <= 300; ++i) {
    const float v = track.at(0, i / 100.0);
    EXPECT_GE(v, 0);
    EXPECT_LE(v, 5);
    EXPECT_GE(v, track.at(0, (i - 1) / 100.0));
  }
  const WalkTrack line{{0, 1, 3}, {{0, 1, 3}}};
  EXPECT_FLOAT_EQ(line.at(0, 1), 1);
  EXPECT_LT(line.at(0, 0.01), 0.001f);  // sets out from rest
}

TEST_F(WalkFile, errorsSayWhere) {
  expectError("{", "walk.json");
  expectError(R"({"seconds": 2})", "needs seconds and camera");
  expectError(R"({"seconds": 2, "camera": [], "speed": 1})", "speed");
  expectError(R"({"seconds": 2, "camera": []})", "camera");
  expectError(R"({"seconds": 2, "camera": [{"time": 0, "position": [0, 1, 0], "target": [0, 1, 0]}]})",
              "camera[0].target");
  expectError(
      R"({"seconds": 2, "camera": [{"time": 1, "position": [0, 1, 0], "target": [1, 1, 0]}, {"time": 1, "position": [0, 1, 0], "target": [1, 1, 0]}]})",
      "must be later");
  expectErrorOf(R"("objects": [{"name": "Table", "keys": [{"time": 0}]}])", "there are");
  expectErrorOf(R"("objects": [{"name": "Table", "keys": [{"time": 0}]}])", "'Chair'");
  expectErrorOf(R"("objects": [{"name": "Chair", "keys": [{"time": 0}]}])", "\"number\": 1 to 2");
  expectErrorOf(R"("objects": [{"name": "Chair", "number": 3, "keys": [{"time": 0}]}])", "objects[0].number");
  expectErrorOf(
      R"("objects": [{"name": "Chair", "number": 1, "keys": [{"time": 0}]}, {"name": "Chair", "number": 1, "keys": [{"time": 0}]}])",
      "second time");
  expectErrorOf(R"("objects": [{"name": "Chair", "number": 1, "keys": [{"time": 0, "by": 1}]}])", "by");
  expectErrorOf(R"("lamps": [{"name": "Sun", "keys": [{"time": 0, "dimming": 1}]}])", "'Bulb', 'Pendant'");
  expectErrorOf(R"("lamps": [{"name": "Bulb", "keys": [{"time": 0, "dimming": 2}]}])", "lamps[0].keys[0].dimming");
}

}  // namespace
}  // namespace roomlight
