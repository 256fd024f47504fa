#include "bake/stitch.h"

#include <gtest/gtest.h>

#include <array>

namespace roomlight::bake {
namespace {

// A rectangle from x = `from` to `to` on the floor, z from `near` to `far`, as two triangles that face up.
void addFloor(Batch& batch, Vec2 x, Vec2 z, bool vertexLit = false) {
  const auto first = static_cast<uint32_t>(batch.positions.size());
  for (const Vec2 corner : {Vec2{x.x, z.x}, Vec2{x.x, z.y}, Vec2{x.y, z.y}, Vec2{x.y, z.x}}) {
    batch.positions.push_back({corner.x, 0, corner.y});
    batch.normals.push_back({0, 127, 0, 0});
    batch.uv.push_back(corner);
    batch.atlas.push_back({static_cast<uint16_t>(1000 * corner.x), static_cast<uint16_t>(1000 * corner.y)});
    batch.colors.push_back({255, 255, 255, 255});
    batch.vertexLit.push_back({static_cast<uint8_t>(vertexLit), 0, 0, 0});
  }
  for (const uint32_t k : {0u, 1u, 2u, 0u, 2u, 3u}) batch.indices.push_back(first + k);
}

double area(const Batch& batch) {
  double sum = 0;
  for (size_t t = 0; t + 2 < batch.indices.size(); t += 3) {
    const auto at = [&](size_t k) { return batch.positions[batch.indices[t + k]]; };
    const Vec3 n = cross(at(1) - at(0), at(2) - at(0));
    EXPECT_GT(n.y, 0) << "still faces up";
    sum += static_cast<double>(length(n)) / 2;
  }
  return sum;
}

// A long floor beside three short ones.
TEST(Stitch, aLongEdgeGetsTheVerticesOfItsNeighbours) {
  Batch floor, beside;
  addFloor(floor, {0, 6}, {0, 2});
  for (const float x : {0.0f, 2.0f, 4.0f}) addFloor(beside, {x, x + 2}, {2, 3});
  const std::array<Batch*, 2> all{&floor, &beside};
  stitch(all);
  EXPECT_EQ(floor.indices.size(), 3u * 4) << "one triangle more for each of two vertices";
  EXPECT_EQ(beside.indices.size(), 3u * 6);
  EXPECT_NEAR(area(floor), 12, 1e-4);
  for (const float x : {2.0f, 4.0f}) {
    const auto at = std::find(floor.positions.begin(), floor.positions.end(), Vec3(x, 0, 2));
    ASSERT_NE(at, floor.positions.end()) << x;
    const auto v = static_cast<size_t>(at - floor.positions.begin());
    EXPECT_EQ(floor.normals[v][1], 127);
    EXPECT_NEAR(floor.uv[v].x, x, 1e-5);
    EXPECT_EQ(floor.atlas[v], (std::array<uint16_t, 2>{static_cast<uint16_t>(1000 * x), 2000}));
    EXPECT_EQ(floor.vertexLit[v][0], 0);
  }
}

TEST(Stitch, verticesThatAreAllButAtOnePlaceComeTogether) {
  Batch left, right;
  addFloor(left, {0, 1}, {0, 1});
  addFloor(right, {1.0001f, 2}, {0.0001f, 1});
  const std::array<Batch*, 2> all{&left, &right};
  stitch(all);
  EXPECT_TRUE(right.positions[0] == left.positions[3]);
  EXPECT_TRUE(right.positions[1] == left.positions[2]);
  EXPECT_EQ(left.indices.size(), 6u);
  EXPECT_EQ(right.indices.size(), 6u);
}

TEST(Stitch, whatIsLitByVerticesStaysAndOthersComeToIt) {
  Batch floor, fine;
  addFloor(floor, {0, 6}, {0, 2});
  addFloor(fine, {2, 4}, {2, 3}, true);
  floor.positions[0].x += 0.0002f;
  addFloor(fine, {0, 2}, {-2, 0}, true);
  const std::vector<Vec3> before = fine.positions;
  const std::array<Batch*, 2> all{&floor, &fine};
  stitch(all);
  EXPECT_EQ(fine.indices.size(), 12u);
  EXPECT_EQ(fine.positions, before);
  EXPECT_NE(std::find(before.begin(), before.end(), floor.positions[0]), before.end());
  EXPECT_GT(floor.indices.size(), 6u);  // corners of the fine floor lie on an edge
}

}  // namespace
}  // namespace roomlight::bake
