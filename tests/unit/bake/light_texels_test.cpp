#include "bake/light_texels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "bake/predicted_texels.h"
#include "base/random.h"
#include "unit/bake/texels_of.h"

namespace roomlight::bake {
namespace {

TEST(LightTexels, comeBackWithinAFifthOfAPercentOfTheLargestChannel) {
  Rng random(1, 2, 3);
  for (int i = 0; i < 10000; ++i) {
    const float size = std::exp2(random.uniform() * 28 - 12);
    const Vec3 v{random.uniform() * size, random.uniform() * size, random.uniform() * size};
    const Vec3 back = fromRgb9e5(rgb9e5(v));
    for (int c = 0; c < 3; ++c) ASSERT_NEAR(back[c], v[c], maxComponent(v) * 0.002f) << i;
  }
}

TEST(LightTexels, whatIsNoLightIsDarkAndWhatIsTooBrightIsClipped) {
  EXPECT_EQ(rgb9e5({0, 0, 0}), 0u);
  EXPECT_EQ(rgb9e5({-1, std::numeric_limits<float>::quiet_NaN(), 0}), 0u);
  EXPECT_NEAR(fromRgb9e5(rgb9e5(Vec3(1e9f))).x, 65408, 1);
  EXPECT_NEAR(fromRgb9e5(rgb9e5(Vec3(511.9f))).x, 512, 0.1);  // the mantissa rounds up into the exponent
}

TEST(LightTexels, sunlightIsScaledAndDarkTilesAreLeftOut) {
  Image light(64, 32);
  for (int y = 0; y < 32; ++y) {
    for (int x = 32; x < 64; ++x) light.at(x, y) = Vec3(90000, 80000, static_cast<float>(x));
  }
  const LightTexels texels = lightTexels(light, 32);
  EXPECT_EQ(texels.tiles, std::vector<uint32_t>{1});
  EXPECT_EQ(texels.scale, 2);
  const std::vector<uint32_t> back = texelsOf(texels.stream, 32 * 32, 32, 32);
  const Vec3 first = fromRgb9e5(back[0]) * texels.scale, last = fromRgb9e5(back.back()) * texels.scale;
  EXPECT_NEAR(first.x, 90000, 180);
  EXPECT_NEAR(first.y, 80000, 180);
  EXPECT_NEAR(last.z, 63, 180);
}

// What is smooth, what is noise, the ends of all ranges; three tiles that are not square.
TEST(LightTexels, predictedOnesComeBackBitByBit) {
  constexpr int kWidth = 24, kHeight = 16;
  Rng random(7, 8, 9);
  std::vector<uint32_t> texels;
  for (int i = 0; i < 3 * kWidth * kHeight; ++i) {
    const int tile = i / (kWidth * kHeight);
    const float x = static_cast<float>(i % kWidth), y = static_cast<float>(i / kWidth);
    const Vec3 smooth = Vec3(1, 0.8f, 0.3f) * std::exp2((x - y) / 3);
    const auto noise = static_cast<uint32_t>(random.uniform() * 4294967040.0f);
    texels.push_back(tile == 0 ? rgb9e5(smooth) : tile == 1 ? noise : (i % 5 < 2 ? 0 : i % 5 == 2 ? 0xffffffff : 511));
  }
  const std::string planes = predictedPlanes(texels, kWidth, kHeight);
  EXPECT_TRUE(texelsOf(deflated(planes), texels.size(), kWidth, kHeight) == texels);
}

TEST(LightTexels, sumsOfManyLayersStayWithinOnePercent) {
  Rng random(4, 5, 6);
  for (int i = 0; i < 1000; ++i) {
    Vec3 sum, back;
    for (int layer = 0; layer < 30; ++layer) {
      const Vec3 v = Vec3(random.uniform(), random.uniform(), random.uniform()) * 200;
      sum += v, back += fromRgb9e5(rgb9e5(v));
    }
    ASSERT_NEAR(luminance(back), luminance(sum), 0.01f * luminance(sum));
  }
}

}  // namespace
}  // namespace roomlight::bake
