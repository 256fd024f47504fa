#include "gather/noise_left.h"

#include <gtest/gtest.h>

namespace roomlight {
namespace {

constexpr size_t kPixels = 256;

FilteredLuminance leftOf(float luminance, float deviation) { return {std::vector<float>(kPixels, luminance), std::vector<float>(kPixels, deviation * deviation)}; }

TEST(NoiseLeft, isThatOfThePixels) {
  const std::vector<uint32_t> rays(kPixels, 4);
  EXPECT_NEAR(noiseLeft(leftOf(100, 2), rays, rays), 0.02 / 1.05, 1e-4);
}

TEST(NoiseLeft, fallsWithFurtherRays) {
  const std::vector<uint32_t> then(kPixels, 4), now(kPixels, 16);
  EXPECT_NEAR(noiseLeft(leftOf(100, 2), then, now), noiseLeft(leftOf(100, 1), then, then), 1e-6);
}

TEST(NoiseLeft, isNotKnownWithoutAPlan) { EXPECT_LT(noiseLeft({}, {}, {}), 0); }

}  // namespace
}  // namespace roomlight
