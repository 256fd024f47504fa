#include "gather/pixel_shader.h"

#include <gtest/gtest.h>

namespace roomlight {
namespace {

constexpr int kWidth = 24, kHeight = 12;

// A flat wall of even light, but for one column that is dark; each pixel on an edge has contrast to what lies beside.
std::vector<uint16_t> needed(bool wraps, int darkColumn, int edgeColumn) {
  FilterInput sums(kWidth, kHeight);
  sums.wraps = wraps;
  std::vector<PixelCount> counts(sums.pixels.size());
  FilteredLuminance left;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      FilterPixel& p = sums.at(x, y);
      p.diffuse = Vec3(4), p.albedo = Vec3(4), p.normal = {0, 0, 4}, p.surface = 4;
      PixelCount& count = counts[static_cast<size_t>(y * kWidth + x)];
      count.rays = count.gathered = count.glossy = 4, count.edge = x == edgeColumn;
      left.luminance.push_back(x == darkColumn ? 0.0f : 1.0f), left.variance.push_back(0);
    }
  }
  return raysNeeded(sums, counts, left, 0.05f);
}

TEST(NoiseMap, edgesAskByTheirContrast) {
  const std::vector<uint16_t> rays = needed(false, 5, 6);
  EXPECT_GT(rays[3 * kWidth + 6], 0);
  EXPECT_EQ(rays[3 * kWidth + 8], 0);
  EXPECT_EQ(needed(false, 5, 9)[3 * kWidth + 9], 0);
}

TEST(NoiseMap, aPanoramaGoesOnAtItsOtherSide) {
  EXPECT_EQ(needed(false, kWidth - 1, 0)[3 * kWidth], 0);
  EXPECT_GT(needed(true, kWidth - 1, 0)[3 * kWidth], 0);
}

}  // namespace
}  // namespace roomlight
