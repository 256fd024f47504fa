// Cameras that look down at a home see into it, not its roof; all others see what they always did.
#include <gtest/gtest.h>

#include "home/cameras.h"
#include "home/rooms.h"
#include "support/furnished.h"
#include "trace/camera_rays.h"

namespace roomlight::home {
namespace {

constexpr int kFacesOfABox = 6;

Camera lookingAt(Vec3 eye, Vec3 target) {
  Camera camera;
  camera.worldFromCamera = looking(eye, target - eye);
  camera.yFovRad = 0.7f;
  return camera;
}

Room roomOf(float elevationM, float heightM) {
  Room room;
  room.floor = {{0, 0}, {0, 4}, {5, 4}, {5, 0}};
  room.elevationM = elevationM, room.heightM = heightM;
  return room;
}

const Vec3 kMiddle{2.5f, 1, 2}, kAbove{2.5f, 9, 10};

TEST(CutOpen, aCameraAboveAClosedRoomLooksIntoIt) {
  const Scene scene = test::furnishedRoom();
  const RayScene rays(scene);
  const std::vector<Room> rooms = findRooms(rays);
  const std::optional<float> cut = cutHeightFor(rays, rooms, lookingAt(kAbove, kMiddle));
  ASSERT_TRUE(cut);
  EXPECT_GT(*cut, 1.1f);
  EXPECT_LT(*cut, 2.58f);
  Camera camera = lookingAt(kAbove, kMiddle);
  camera.cutHeightM = *cut;
  const Ray ray = CameraRays(camera, 100, 100).ray(50, 50);
  const Hit hit = rays.intersect(ray);
  ASSERT_TRUE(hit.valid());
  EXPECT_LT((ray.origin + ray.direction * hit.t).y, 1.5f) << "furniture or the floor";
}

TEST(CutOpen, straightDownCutsJustUnderTheCeiling) {
  const Scene scene = test::furnishedRoom();
  const RayScene rays(scene);
  const std::vector<Room> rooms = {roomOf(0, 2.6f)};
  EXPECT_NEAR(cutHeightFor(rays, rooms, lookingAt({2.5f, 12, 2}, kMiddle)).value_or(0), 2.55, 1e-4);
}

TEST(CutOpen, otherCamerasSeeWhatTheyAlwaysDid) {
  const Scene scene = test::furnishedRoom();
  const RayScene rays(scene);
  const std::vector<Room> rooms = {roomOf(0, 2.6f)};
  EXPECT_FALSE(cutHeightFor(rays, rooms, lookingAt({2.5f, 1.6f, 14}, kMiddle))) << "before the front";
  EXPECT_FALSE(cutHeightFor(rays, rooms, lookingAt({2.5f, 6, 20}, kMiddle))) << "higher, but the front is what it sees";
  EXPECT_FALSE(cutHeightFor(rays, rooms, lookingAt({4, 2.3f, 3.5f}, {2, 0, 1}))) << "indoors";
  EXPECT_FALSE(cutHeightFor(rays, rooms, lookingAt(kAbove, {2.5f, 8, 30}))) << "away from the home";
  EXPECT_FALSE(cutHeightFor(rays, {}, lookingAt(kAbove, kMiddle))) << "no rooms";
}

TEST(CutOpen, homesWithoutARoofAreOpenAsTheyAre) {
  Scene scene = test::furnishedRoom();
  const auto roof = scene.instances.begin() + kFacesOfABox;  // the second box
  scene.instances.erase(roof, roof + kFacesOfABox);
  const RayScene rays(scene);
  EXPECT_FALSE(cutHeightFor(rays, {roomOf(0, 2.6f)}, lookingAt(kAbove, kMiddle)));
}

// Ground floor with a ceiling, and walls of an upper floor without one.
TEST(CutOpen, anOpenUpperFloorStays) {
  Scene scene = test::furnishedRoom();
  test::addBox(scene, {-0.2f, 2.8f, -0.2f}, {0, 4, 4.2f}, 0);
  test::addBox(scene, {5, 2.8f, -0.2f}, {5.2f, 4, 4.2f}, 0);
  const RayScene rays(scene);
  EXPECT_FALSE(cutHeightFor(rays, {roomOf(0, 2.6f), roomOf(2.8f, 2.5f)}, lookingAt({2.5f, 14, 8}, {2.5f, 3, 2})));
}

// A gable roof from 1 m over the floor at the eaves to 3.5 m at the ridge, along x.
TEST(CutOpen, underASlopingRoofTheCutIsLower) {
  Scene scene;
  const int white = test::addMaterial(scene, test::lambertian(0.7f));
  test::addBox(scene, {0, -0.2f, 0}, {5, 0, 4}, white);
  test::addRectangle(scene, {0, 1, 0}, {0, 2.5f, 2}, {5, 0, 0}, white);
  test::addRectangle(scene, {0, 1, 4}, {5, 0, 0}, {0, 2.5f, -2}, white);
  const RayScene rays(scene);
  const std::optional<float> cut = cutHeightFor(rays, {roomOf(0, 3.5f)}, lookingAt({2.5f, 12, 2.1f}, kMiddle));
  ASSERT_TRUE(cut);
  EXPECT_LE(*cut, 2.0f);
}

}  // namespace
}  // namespace roomlight::home
