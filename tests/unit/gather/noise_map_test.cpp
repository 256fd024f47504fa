#include "gather/pixel_shader.h"

#include <gtest/gtest.h>

namespace roomlight {
namespace {

constexpr int kWidth = 24, kHeight = 12;

struct Wall {
  FilterInput sums{kWidth, kHeight};
  std::vector<PixelCount> counts{sums.pixels.size()};
  FilteredLuminance left;
};

// A flat wall of even light, but for one column that is dark; each pixel on an edge has contrast to what lies beside.
Wall wallOf(bool wraps, int darkColumn, int edgeColumn) {
  Wall wall;
  auto& [sums, counts, left] = wall;
  sums.wraps = wraps;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      FilterPixel& p = sums.at(x, y);
      p.diffuse = Vec3(4), p.albedo = Vec3(4), p.normal = {0, 0, 4}, p.surface = 4;
      PixelCount& count = counts[static_cast<size_t>(y * kWidth + x)];
      count.rays = count.gathered = count.glossy = 4, count.edge = x == edgeColumn;
      left.luminance.push_back(x == darkColumn ? 0.0f : 1.0f), left.variance.push_back(0);
    }
  }
  return wall;
}

std::vector<uint16_t> needed(const Wall& wall, const Plane& thin = {}) {
  return raysNeeded(wall.sums, wall.counts, wall.left, thin, 0.05f);
}
std::vector<uint16_t> needed(bool wraps, int darkColumn, int edgeColumn) {
  return needed(wallOf(wraps, darkColumn, edgeColumn));
}

// A groove or a wire along column 12, seen by one ray of four in every pixel there.
std::vector<Fragments> thinThing(Vec3 light, Vec3 normal) {
  Fragments seen;
  for (int y = 0; y < kHeight; ++y)
    seen.all.push_back({static_cast<uint32_t>(y * kWidth + 12), light, Vec3(1), normal, Vec3(0), 1, luminance(light)});
  return {seen};
}

TEST(NoiseMap, edgesAskByTheirContrast) {
  const std::vector<uint16_t> rays = needed(false, 5, 6);
  EXPECT_GT(rays[3 * kWidth + 6], 0);
  EXPECT_EQ(rays[3 * kWidth + 8], 0);
  EXPECT_EQ(needed(false, 5, 9)[3 * kWidth + 9], 0);
}

// Whose rays have met one side by chance.
TEST(NoiseMap, pixelsBesideAnEdgeAskToo) {
  const std::vector<uint16_t> rays = needed(false, 5, 6);
  EXPECT_GT(rays[3 * kWidth + 5], 0);
  EXPECT_EQ(rays[3 * kWidth + 4], 0);  // no edge beside it
  EXPECT_EQ(rays[3 * kWidth + 7], 0);  // no contrast
}

TEST(NoiseMap, thingsThinnerThanPixelsAskByTheirOwnContrast) {
  const Wall wall = wallOf(false, -1, 12);
  const size_t there = 5 * kWidth + 12;
  EXPECT_EQ(needed(wall)[there], 0);
  const auto withLight = [&](float light) {
    return needed(wall, thinThings(thinThing(Vec3(light), {1, 0, 0}), wall.sums, wall.counts));
  };
  EXPECT_GT(withLight(0)[there], 0);  // a black groove
  EXPECT_GT(withLight(5)[there], 0);
  EXPECT_EQ(withLight(1)[there], 0);  // as bright as the wall
  EXPECT_GT(withLight(0)[there - 1], 0);
  EXPECT_EQ(withLight(0)[there - 2], 0);
}

TEST(NoiseMap, whatPixelsBesideShowIsNotThin) {
  const Wall wall = wallOf(false, -1, 12);
  const size_t there = 5 * kWidth + 12;
  EXPECT_EQ(thinThings(thinThing(Vec3(3), {1, 0, 0}), wall.sums, wall.counts).values[there], 3);
  EXPECT_EQ(thinThings(thinThing(Vec3(3), {0, 0, 1}), wall.sums, wall.counts).values[there], -1);
  EXPECT_EQ(thinThings(thinThing(Vec3(3), {1, 0, 0}), wall.sums, wall.counts).values[there + 1], -1);
}

TEST(NoiseMap, aPanoramaGoesOnAtItsOtherSide) {
  EXPECT_EQ(needed(false, kWidth - 1, 0)[3 * kWidth], 0);
  EXPECT_GT(needed(true, kWidth - 1, 0)[3 * kWidth], 0);
}

}  // namespace
}  // namespace roomlight
