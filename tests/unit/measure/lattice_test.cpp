#include "measure/lattice.h"

#include <gtest/gtest.h>

#include <cmath>

#include "scene/outline.h"

namespace roomlight {
namespace {

const std::vector<Vec2> kSquare = {{0, 0}, {0, 4}, {4, 4}, {4, 0}};

TEST(MeterGrid, spacingGrowsWithTheArea) {
  EXPECT_NEAR(gridSpacingM(4, 4), 0.5270, 1e-4);
  EXPECT_NEAR(gridSpacingM(4, 3), 0.5270, 1e-4);
  EXPECT_NEAR(gridSpacingM(1, 1), 0.2, 1e-9);
  EXPECT_NEAR(gridSpacingM(10, 6), 1, 1e-9);
  EXPECT_NEAR(gridSpacingM(4, 20), 0.5270, 1e-4);  // a corridor: its width decides
  EXPECT_EQ(gridSpacingM(5000, 4000), 10);
}

TEST(MeterGrid, floorOfARoomLeavesTheBorderOut) {
  const MeterGrid l = floorLattice(kSquare, 0.85f, {});
  // 3 m are left, p = 0.431 m: 7 cells a side.
  EXPECT_EQ(l.columns, 7);
  EXPECT_EQ(l.rows, 7);
  EXPECT_EQ(l.count(), 49u);
  for (const SurfaceElement& e : l.elements()) {
    EXPECT_FLOAT_EQ(e.position.y, 0.85f);
    EXPECT_TRUE(e.normal == Vec3(0, 1, 0));
    EXPECT_GE(distanceToEdgeM(kSquare, {e.position.x, e.position.z}), 0.5);
  }
}

TEST(MeterGrid, smallRoomsKeepMostOfTheirFloor) {
  const std::vector<Vec2> bath = {{0, 0}, {0, 2}, {1, 2}, {1, 0}};
  double nearest = 1;
  for (const SurfaceElement& e : floorLattice(bath, 0, {0.01, 0.5, 0.15}).elements())
    nearest = std::min(nearest, distanceToEdgeM(bath, {e.position.x, e.position.z}));
  EXPECT_NEAR(nearest, 0.155, 0.002);
}

TEST(MeterGrid, floorWithACornerCutOut) {
  const std::vector<Vec2> floor = {{0, 0}, {0, 6}, {3, 6}, {3, 3}, {6, 3}, {6, 0}};
  EXPECT_NEAR(signedAreaM2(floor), 27, 1e-9);
  const MeterGrid l = floorLattice(floor, 0, {0.1, 0, 0});
  EXPECT_NEAR(static_cast<double>(l.count()) * 0.01, 27, 0.3);
}

TEST(MeterGrid, followsATurnedRoom) {
  const float c = std::cos(0.5f), s = std::sin(0.5f);
  std::vector<Vec2> floor;
  for (const Vec2 p : kSquare) floor.push_back({c * p.x - s * p.y * 1.5f, s * p.x + c * p.y * 1.5f});
  const MeterGrid l = floorLattice(floor, 0, {});
  EXPECT_EQ(l.count(), static_cast<size_t>(l.columns) * static_cast<size_t>(l.rows));
  EXPECT_NEAR(static_cast<double>(dot(l.u, {c, 0, s})), 1, 1e-5);
}

TEST(MeterGrid, wallsLookInwards) {
  std::vector<Vec2> turned(kSquare.rbegin(), kSquare.rend());
  for (const auto& floor : {kSquare, turned}) {
    const std::vector<MeterGrid> walls = wallLattices(floor, 1, 2.5f, {});
    ASSERT_EQ(walls.size(), 4u);
    for (const MeterGrid& wall : walls) {
      for (const SurfaceElement& e : wall.elements()) {
        EXPECT_TRUE(contains(floor, {e.position.x, e.position.z}));
        EXPECT_GT(dot(Vec3{2, e.position.y, 2} - e.position, e.normal), 1.9f);
        EXPECT_GT(e.position.y, 1);
        EXPECT_LT(e.position.y, 3.5f);
      }
    }
  }
}

TEST(Statistics, leaveOutWhatIsNoNumber) {
  const std::vector<float> values = {100, std::nanf(""), 300, 200};
  const Statistics s = statisticsOf(values);
  EXPECT_EQ(s.points, 3u);
  EXPECT_DOUBLE_EQ(s.mean, 200);
  EXPECT_DOUBLE_EQ(s.u0(), 0.5);
  EXPECT_DOUBLE_EQ(s.u1(), 1.0 / 3);
  EXPECT_EQ(statisticsOf({}).points, 0u);
  EXPECT_EQ(statisticsOf({}).u0(), 0);
}

TEST(MeterGrid, spreadsReadingsOntoUsedCells) {
  MeterGrid l;
  l.columns = 3, l.rows = 1, l.used = {1, 0, 1};
  const std::vector<float> two = {5, 7}, all = l.spread(two);
  EXPECT_EQ(all[0], 5);
  EXPECT_TRUE(std::isnan(all[1]));
  EXPECT_EQ(all[2], 7);
}

}  // namespace
}  // namespace roomlight
