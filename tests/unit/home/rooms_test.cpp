#include "home/rooms.h"

#include <gtest/gtest.h>

#include "scene/outline.h"
#include "support/furnished.h"

namespace roomlight::home {
namespace {

TEST(Rooms, haveTheOutlineOfTheirFloor) {
  // An L of 6 x 4 m less 3 x 2 m.
  Scene scene;
  const int white = test::addMaterial(scene, test::lambertian(0.7f));
  test::addRoom(scene, {0, 0, 0}, {6, 2.5f, 4}, std::vector<int>(6, white));
  test::addBox(scene, {3, 0.005f, 2}, {5.995f, 2.495f, 3.995f},
               white);  // of two surfaces in one place either may be met
  const RayScene rays(scene);
  const std::vector<Room> rooms = findRooms(rays);
  ASSERT_EQ(rooms.size(), 1u);
  EXPECT_EQ(rooms[0].name, "Room 1");
  EXPECT_NEAR(areaM2(rooms[0]), 18, 1.5);
  EXPECT_GT(signedAreaM2(rooms[0].floor), 0);
  EXPECT_NEAR(rooms[0].heightM, 2.5, 0.01);
  EXPECT_TRUE(isIn(rooms[0], {1, 1, 3}));
  EXPECT_FALSE(isIn(rooms[0], {5, 1, 3}));
  EXPECT_FALSE(isIn(rooms[0], {1, 3, 3}));
}

TEST(Rooms, areFoundWithFurnitureInThem) {
  const Scene scene = test::furnishedRoom();
  const RayScene rays(scene);
  const std::vector<Room> rooms = findRooms(rays);
  ASSERT_EQ(rooms.size(), 1u);
  EXPECT_NEAR(areaM2(rooms[0]), 20, 2.5);
}

TEST(Rooms, areNotBetweenTwoPlates) {
  Scene scene;
  const int grey = test::addMaterial(scene, test::lambertian(0.5f));
  test::addBox(scene, {0, -0.2f, 0}, {6, 0, 6}, grey);
  test::addBox(scene, {0, 2.6f, 0}, {6, 2.8f, 6}, grey);
  const RayScene rays(scene);
  EXPECT_TRUE(findRooms(rays).empty());
}

TEST(Rooms, areNotInLogs) {
  Scene scene;
  const int wood = test::addMaterial(scene, test::lambertian(0.4f));
  test::addTube(scene, {0, 0, 0}, 2, 16, wood);
  Affine lying;  // its axis, y, along x
  lying.x = {0, -1, 0}, lying.y = {1, 0, 0}, lying.w = {0, 2, 0};
  scene.instances[0].worldFromObject = lying;
  const RayScene rays(scene);
  EXPECT_TRUE(findRooms(rays).empty());
}

TEST(Rooms, areNotInChairs) {
  const Scene scene = test::chair();
  const RayScene rays(scene);
  EXPECT_TRUE(findRooms(rays).empty());
}

}  // namespace
}  // namespace roomlight::home
