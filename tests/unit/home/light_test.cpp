#include "home/light.h"

#include <gtest/gtest.h>

#include "home/cameras.h"
#include "home/rooms.h"
#include "import/lighting_file.h"
#include "support/furnished.h"

namespace roomlight::home {
namespace {

AddedLight added(const Scene& scene, Mood mood) {
  const RayScene rays(scene);
  const std::vector<Room> rooms = findRooms(rays);
  return lightFor(rays, rooms, proposeCameras(rays, rooms, true).front(), mood);
}

Scene lit(Scene scene, const AddedLight& light) {
  const Status s = applyLighting(light.document, "test", scene);
  EXPECT_TRUE(s) << s.error();
  return scene;
}

TEST(AddedLight, ofARoomWithAWindowIsSunThroughItAndALamp) {
  const Scene room = test::furnishedRoom();
  const AddedLight light = added(room, Mood::Auto);
  EXPECT_EQ(light.summary, "daylight and a ceiling lamp");
  const Scene scene = lit(room, light);
  ASSERT_EQ(scene.suns.size(), 1u);
  EXPECT_LT(scene.suns[0].toLight.z, -0.2f);  // the window is towards -z
  EXPECT_GT(luminance(scene.suns[0].illuminanceLux), 10000);
  EXPECT_TRUE(scene.sky.present());
  ASSERT_EQ(scene.lamps.size(), 1u);
  EXPECT_EQ(scene.lamps[0].name, "Room 1 ceiling lamp");
  EXPECT_NEAR(scene.lamps[0].position.y, 2.54, 0.02);
  EXPECT_FALSE(light.document.contains("ground"));
}

TEST(AddedLight, ofARoomWithoutWindowsIsALamp) {
  const Scene room = test::furnishedRoom(false);
  EXPECT_EQ(lit(room, added(room, Mood::Auto)).lamps.size(), 1u);
  EXPECT_EQ(lit(room, added(room, Mood::Day)).lamps.size(), 1u);  // daylight does not reach it
}

// Beside a room with a window.
TEST(AddedLight, byDayIsALampInARoomThatNoDaylightReaches) {
  Scene home = test::furnishedRoom();
  const Scene closet = test::furnishedRoom(false);
  for (Instance instance : closet.instances) {
    instance.mesh += static_cast<int>(home.meshes.size());
    instance.worldFromObject.w.z += 4.4f;
    home.instances.push_back(instance);
  }
  home.meshes.insert(home.meshes.end(), closet.meshes.begin(), closet.meshes.end());
  const AddedLight light = added(home, Mood::Day);
  EXPECT_EQ(light.summary, "daylight and a ceiling lamp");
  EXPECT_GT(lit(home, light).lamps.at(0).position.z, 4.4f);
}

TEST(OutdoorLight, comesInThroughAWindowAlone) {
  const auto comesIn = [](bool window) {
    Scene room = test::furnishedRoom(window);
    room.suns.push_back({"Sun", {0, 0.4f, -0.9f}, Vec3(50000), 0.00465f});
    room.sky.luminanceCdM2 = Vec3(2000);
    const RayScene rays(room);
    const std::vector<Room> rooms = findRooms(rays);
    return outdoorLightComesIn(rays, rooms, proposeCameras(rays, rooms, true).front());
  };
  EXPECT_TRUE(comesIn(true));
  EXPECT_FALSE(comesIn(false));
}

TEST(AddedLight, byDayIsNoLampWhereDaylightComes) {
  const Scene room = test::furnishedRoom();
  EXPECT_EQ(added(room, Mood::Day).summary, "daylight");
}

TEST(AddedLight, inTheEveningIsLampsAndADarkSky) {
  const Scene room = test::furnishedRoom();
  const Scene scene = lit(room, added(room, Mood::Evening));
  EXPECT_TRUE(scene.suns.empty());
  EXPECT_LT(luminance(scene.sky.luminanceCdM2), 20);
  EXPECT_EQ(scene.lamps.size(), 1u);
}

TEST(AddedLight, byNightIsTheSameUnderADarkerSky) {
  const Scene room = test::furnishedRoom();
  const Scene evening = lit(room, added(room, Mood::Evening)), night = lit(room, added(room, Mood::Night));
  EXPECT_TRUE(night.suns.empty());
  EXPECT_EQ(night.lamps.size(), evening.lamps.size());
  const auto sum = [](const Scene& scene) {
    double all = 0;
    for (const Vec3 p : scene.sky.image.pixels) all += static_cast<double>(luminance(p));
    return all;
  };
  EXPECT_GT(sum(night), 0);
  EXPECT_LT(sum(night), 0.02 * sum(evening));
}

TEST(AddedLight, inTheEveningLeavesARoomsOwnLampsAlone) {
  Scene room = test::furnishedRoom();
  room.lamps.push_back(test::pointLamp({2, 2, 2}, 60));
  const AddedLight light = added(room, Mood::Evening);
  EXPECT_FALSE(light.document.contains("lamps")) << light.document.dump();
}

TEST(AddedLight, ofASinglePieceIsSunSkyAndAGroundToStandOn) {
  const Scene chair = test::chair();
  const AddedLight light = added(chair, Mood::Auto);
  EXPECT_EQ(light.summary, "daylight and a ground");
  const Scene scene = lit(chair, light);
  ASSERT_EQ(scene.instances.size(), chair.instances.size() + 1);
  const Bounds3 ground = instanceBounds(scene, scene.instances.back());
  EXPECT_LE(ground.hi.y, 0);
  EXPECT_GT(ground.hi.y, -0.01f);
  EXPECT_LT(ground.lo.x, -3);
}

TEST(OwnLight, knowsWhatThereIs) {
  Scene room = test::furnishedRoom();
  EXPECT_TRUE(ownLightOf(room).none());
  room.lamps.push_back(test::pointLamp({2, 2, 2}, 60));
  EXPECT_FALSE(ownLightOf(room).none());
  EXPECT_FALSE(ownLightOf(room).faint());
  room.lamps[0].intensityCd = Vec3(0.5f);
  EXPECT_FALSE(ownLightOf(room).none());
  EXPECT_TRUE(ownLightOf(room).faint());
  room.lamps[0].position = {500, 2, 2};
  EXPECT_TRUE(ownLightOf(room).none());
  EXPECT_EQ(ownLightOf(room).farLamps.size(), 1u);
}

// A display that glows does not light a room.
TEST(OwnLight, aFaintGlowIsNone) {
  Scene room = test::furnishedRoom();
  const int screen = test::addMaterial(room, test::lambertian(0, 5));
  test::addRectangle(room, {1, 1, 3.9f}, {1, 0, 0}, {0, 0.6f, 0}, screen);
  EXPECT_TRUE(ownLightOf(room).none());
  room.materials[static_cast<size_t>(screen)].emission = Vec3(5000);
  EXPECT_FALSE(ownLightOf(room).none());
}

}  // namespace
}  // namespace roomlight::home
