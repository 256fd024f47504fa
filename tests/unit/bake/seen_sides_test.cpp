#include "bake/seen_sides.h"

#include <gtest/gtest.h>

#include "support/rooms.h"

namespace roomlight::bake {
namespace {

Room roomOf(float width, float depth) {
  Room room;
  room.floor = {{0, 0}, {0, depth}, {width, depth}, {width, 0}};
  return room;
}

TEST(SeenSides, ofABoxInARoomTheOutside) {
  Scene scene;
  const int grey = addMaterial(scene, lambertian(0.5f));
  addRoom(scene, {0, 0, 0}, {4, 2.5f, 3}, std::vector<int>(6, grey));
  const auto walls = static_cast<uint32_t>(scene.instances.size());
  addBox(scene, {2, 0.9f, 1}, {2.6f, 1.5f, 1.8f}, grey);  // an eye is in it
  scene.rooms = {roomOf(4, 3)};
  const RayScene rays(scene);
  const std::vector<Vec3> eyes = eyesIn(rays);
  EXPECT_GT(eyes.size(), 30u);
  const SeenSides seen = seenFrom(rays, eyes, 1 << 16);
  for (uint32_t i = 0; i < scene.instances.size(); ++i) {
    for (uint32_t t = 0; t < scene.meshes[static_cast<size_t>(scene.instances[i].mesh)].triangleCount(); ++t) {
      EXPECT_TRUE(seen.seen(i, t, false)) << i << (i < walls ? " of the room" : " of the box");
      EXPECT_FALSE(seen.seen(i, t, true)) << i;
    }
  }
}

TEST(SeenSides, ofALargeHollowBlockTheOutsideButOfAClosetTheInside) {
  Scene scene;
  const int grey = addMaterial(scene, lambertian(0.5f));
  addRoom(scene, {0, 0, 0}, {6, 2.5f, 6}, std::vector<int>(6, grey));
  const auto block = static_cast<uint32_t>(scene.instances.size());
  addBox(scene, {1, 0, 1}, {2.8f, 2, 2.8f}, grey);  // some twenty eyes are in it
  const auto closet = static_cast<uint32_t>(scene.instances.size());
  addRoom(scene, {3.5f, 0.01f, 3.5f}, {5.3f, 2.3f, 5.3f}, std::vector<int>(6, grey));
  const auto end = static_cast<uint32_t>(scene.instances.size());
  scene.rooms = {roomOf(6, 6)};
  const RayScene rays(scene);
  const SeenSides seen = seenFrom(rays, eyesIn(rays), 1 << 17);
  const auto sides = [&](uint32_t from, uint32_t to, bool back) {
    size_t sum = 0;
    for (uint32_t i = from; i < to; ++i) {
      for (uint32_t t = 0; t < scene.meshes[static_cast<size_t>(scene.instances[i].mesh)].triangleCount(); ++t)
        sum += seen.seen(i, t, back);
    }
    return sum;
  };
  EXPECT_EQ(sides(block, closet, true), 0u);
  EXPECT_EQ(sides(block, closet, false), 8u);  // its top is above all eyes
  EXPECT_EQ(sides(closet, end, false), 12u);
}

TEST(SeenSides, theCameraInUseCountsFromOutsideToo) {
  Scene scene;
  scene.rooms = {roomOf(4, 3)};
  Camera inside, outside, above;
  inside.worldFromCamera.w = {1, 1.5f, 1}, outside.worldFromCamera.w = {1, 1.5f, 9};
  above = outside, above.cutHeightM = 2.4f;
  scene.cameras = {inside, outside, above};
  EXPECT_EQ(camerasInside(scene).size(), 1u);
  scene.cameraInUse = 1;
  EXPECT_EQ(camerasInside(scene).size(), 2u);
  EXPECT_EQ(cameraInUse(scene, camerasInside(scene)), 1u);
  scene.cameraInUse = 2;
  EXPECT_EQ(camerasInside(scene).size(), 1u);
}

TEST(SeenSides, throughAPaneButNotThroughAWall) {
  Scene scene;
  const int grey = addMaterial(scene, lambertian(0.5f));
  Material glass = lambertian(1);
  glass.transmission = 1;
  addRectangle(scene, {-1, 0, -1}, {2, 0, 0}, {0, 2, 0}, addMaterial(scene, glass));  // 0
  addRectangle(scene, {-1, 0, -2}, {2, 0, 0}, {0, 2, 0}, grey);                       // 1, behind it
  addRectangle(scene, {-1, 0, -3}, {2, 0, 0}, {0, 2, 0}, grey);                       // 2, behind that
  const RayScene rays(scene);
  const Vec3 eye{0, 1, 0};
  const SeenSides seen = seenFrom(rays, {&eye, 1}, 1 << 14);
  const auto any = [&](uint32_t i) { return seen.seen(i, 0, false) || seen.seen(i, 0, true); };
  EXPECT_TRUE(any(0));
  EXPECT_TRUE(any(1));
  EXPECT_FALSE(any(2));
}

TEST(SeenSides, leavesInTheGardenAreAllSeen) {
  Scene scene;
  const int grey = addMaterial(scene, lambertian(0.5f));
  addRectangle(scene, {-2, 0, -1}, {1, 0, 0}, {0, 2, 0}, grey);  // a wall with an opening
  addRectangle(scene, {1, 0, -1}, {1, 0, 0}, {0, 2, 0}, grey);
  const auto leaves = static_cast<uint32_t>(scene.instances.size());
  for (int i = 0; i < 400; ++i) {
    const Vec3 low{-0.5f + 0.05f * static_cast<float>(i % 20), 0.5f + 0.05f * static_cast<float>(i / 20), -8};
    addRectangle(scene, low, {0.02f, 0, 0}, {0, 0.02f, 0}, grey);
  }
  const RayScene rays(scene);
  const std::vector<Vec3> eyes{{0, 1, 0}, {0.2f, 1, 0}, {-0.2f, 1, 0}};
  const SeenSides seen = seenFrom(rays, eyes, 1 << 18);
  size_t fronts = 0, backs = 0;
  for (uint32_t i = leaves; i < leaves + 400; ++i) {
    for (uint32_t t = 0; t < 2; ++t) fronts += seen.seen(i, t, false), backs += seen.seen(i, t, true);
  }
  EXPECT_EQ(fronts, 800u);
  EXPECT_EQ(backs, 0u);
}

}  // namespace
}  // namespace roomlight::bake
