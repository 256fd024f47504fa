#include "measure/lattice.h"

#include <gtest/gtest.h>

#include "support/rooms.h"

namespace roomlight {
namespace {

// A shell of 8 x 2.6 x 4 m in a garden, parted by a wall at x = 5 with an open door of 2 m.
Scene twoRooms() {
  Scene scene;
  const int white = test::addMaterial(scene, test::lambertian(0.7f));
  test::addRectangle(scene, {-60, -0.2f, -60}, {0, 0, 120}, {120, 0, 0}, white);
  test::addRoom(scene, {0, 0, 0}, {8, 2.6f, 4}, std::vector<int>(6, white));
  test::addBox(scene, {4.9f, 0, 0}, {5, 2.6f, 1.5f}, white);
  test::addBox(scene, {4.9f, 0, 2.5f}, {5, 2.6f, 4}, white);
  test::addBox(scene, {4.9f, 2, 1.5f}, {5, 2.6f, 2.5f}, white);
  return scene;
}

TEST(Areas, arePartedByWallsWithDoors) {
  const Scene scene = twoRooms();
  const RayScene rays(scene);
  const std::vector<Area> areas = findAreas(rays, 0.85, {});
  ASSERT_EQ(areas.size(), 2u);
  EXPECT_NEAR(areas[0].areaM2, 4.9 * 4, 2);
  EXPECT_NEAR(areas[1].areaM2, 3 * 4, 1.5);
  EXPECT_NEAR(areas[0].elevationM, 0, 1e-4);
  for (const SurfaceElement& e : areas[0].points.elements()) {
    EXPECT_NEAR(e.position.y, 0.85, 1e-3);
    EXPECT_GT(e.position.x, 0.4f);
    EXPECT_LT(e.position.x, 4.5f);
  }
  EXPECT_GT(areas[0].map.count(), 2 * areas[0].points.count());
}

TEST(Areas, leaveOutWhatIsInAWardrobe) {
  Scene scene = twoRooms();
  test::addBox(scene, {1, 0, 1}, {3, 2, 2}, 0);
  const RayScene rays(scene);
  EXPECT_TRUE(insideThing(rays, {2, 0.85f, 1.5f}));
  EXPECT_FALSE(insideThing(rays, {2, 0.85f, 3}));
  for (const Area& area : findAreas(rays, 0.85, {})) {
    for (const SurfaceElement& e : area.points.elements())
      EXPECT_FALSE(e.position.x > 1 && e.position.x < 3 && e.position.z > 1 && e.position.z < 2);
  }
}

TEST(Areas, areNotTheInsidesOfWalls) {
  Scene scene;
  const int white = test::addMaterial(scene, test::lambertian(0.7f));
  test::addRoom(scene, {0, 0, 0}, {4, 2.6f, 4}, std::vector<int>(6, white));
  test::addRoom(scene, {-0.4f, -0.2f, -0.4f}, {4.4f, 2.8f, 4.4f}, std::vector<int>(6, white));
  const RayScene rays(scene);
  EXPECT_EQ(findAreas(rays, 0.85, {}).size(), 1u);
}

TEST(Areas, thereAreNoneOutOfDoors) {
  Scene scene;
  test::addRectangle(scene, {-5, 0, -5}, {0, 0, 10}, {10, 0, 0}, test::addMaterial(scene, test::lambertian(0.5f)));
  const RayScene rays(scene);
  EXPECT_TRUE(findAreas(rays, 0.85, {}).empty());
}

}  // namespace
}  // namespace roomlight
