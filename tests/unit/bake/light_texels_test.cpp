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

// A lamp is switched off on the right, another comes on in the middle, which had light already; the left stays.
TEST(LightTexels, changesReplaceTheTilesThatDiffer) {
  Image before(96, 32), after(96, 32);
  for (int y = 0; y < 32; ++y) {
    for (int x = 0; x < 96; ++x) {
      before.at(x, y) = Vec3(50, 40, 20);
      after.at(x, y) = x < 32 ? before.at(x, y) : x < 64 ? Vec3(50, 40, static_cast<float>(20 + x)) : Vec3(0);
    }
  }
  const LightTexels change = changedTexels(before, after, 32);
  EXPECT_EQ(change.tiles, (std::vector<uint32_t>{1, 2}));
  const std::vector<uint32_t> back = texelsOf(change.stream, 2 * 32 * 32, 32, 32);
  const LightTexels whole = lightTexels(after, 32);
  EXPECT_EQ(whole.tiles, (std::vector<uint32_t>{0, 1}));
  const std::vector<uint32_t> fresh = texelsOf(whole.stream, 2 * 32 * 32, 32, 32);
  for (size_t i = 0; i < 32 * 32; ++i) {
    ASSERT_EQ(back[i], fresh[32 * 32 + i]) << "as a new bake has it: tile 1";
    ASSERT_EQ(back[32 * 32 + i], 0u) << "dark now: tile 2";
  }
  EXPECT_TRUE(changedTexels(after, after, 32).tiles.empty());
}

constexpr int kWidth = 24, kHeight = 16;

// What is smooth, what is noise, the ends of all ranges; three tiles that are not square.
std::vector<uint32_t> allKinds() {
  Rng random(7, 8, 9);
  std::vector<uint32_t> texels;
  for (int i = 0; i < 3 * kWidth * kHeight; ++i) {
    const int tile = i / (kWidth * kHeight);
    const float x = static_cast<float>(i % kWidth), y = static_cast<float>(i / kWidth);
    const Vec3 smooth = Vec3(1, 0.8f, 0.3f) * std::exp2((x - y) / 3);
    const auto noise = static_cast<uint32_t>(random.uniform() * 4294967040.0f);
    texels.push_back(tile == 0 ? rgb9e5(smooth) : tile == 1 ? noise : (i % 5 < 2 ? 0 : i % 5 == 2 ? 0xffffffff : 511));
  }
  return texels;
}

TEST(LightTexels, predictedOnesComeBackBitByBit) {
  const std::vector<uint32_t> texels = allKinds();
  const std::string planes = predictedPlanes(texels, kWidth, kHeight, 0);
  EXPECT_TRUE(texelsOf(deflated(planes), texels.size(), kWidth, kHeight) == texels);
}

TEST(LightTexels, withSlackMantissasAreAtMostThatFarOff) {
  const std::vector<uint32_t> texels = allKinds();
  const std::vector<uint32_t> back =
      texelsOf(deflated(predictedPlanes(texels, kWidth, kHeight, 1)), texels.size(), kWidth, kHeight);
  int moved = 0;
  for (size_t i = 0; i < texels.size(); ++i) {
    ASSERT_EQ(back[i] >> 27, texels[i] >> 27) << i;
    for (const int shift : {0, 9, 18}) {
      const int off = static_cast<int>(back[i] >> shift & 511) - static_cast<int>(texels[i] >> shift & 511);
      ASSERT_LE(std::abs(off), 1) << i;
      moved += off != 0;
    }
  }
  EXPECT_GT(moved, 500);
}

// Light as meters leave it: a smooth wall with noise of half a per cent.
TEST(LightTexels, slackSavesAQuarterOfNoise) {
  Rng random(1, 1, 1);
  std::vector<uint32_t> texels;
  for (int i = 0; i < 64 * 64; ++i) {
    const float x = static_cast<float>(i % 64), y = static_cast<float>(i / 64);
    const float smooth = 200 + 40 * std::sin(x / 20) + y, noise = 1 + 0.005f * (2 * random.uniform() - 1);
    texels.push_back(rgb9e5(Vec3(1, 0.8f, 0.6f) * smooth * noise));
  }
  const auto size = [&](int slack) { return deflated(predictedPlanes(texels, 64, 64, slack)).size(); };
  EXPECT_LT(static_cast<double>(size(1)), 0.75 * static_cast<double>(size(0)));
}

TEST(LightTexels, sumsOfManyLayersStayWithinOnePercent) {
  Rng random(4, 5, 6);
  for (int i = 0; i < 1000; ++i) {
    Vec3 sum, back;
    for (int layer = 0; layer < 30; ++layer) {
      const Vec3 v = Vec3(random.uniform(), random.uniform(), random.uniform()) * 200;
      const std::string stored = deflated(predictedPlanes({rgb9e5({100, 100, 100}), rgb9e5(v)}, 2, 1, 1));
      sum += v, back += fromRgb9e5(texelsOf(stored, 2, 2, 1)[1]);
    }
    ASSERT_NEAR(luminance(back), luminance(sum), 0.01f * luminance(sum));
  }
}

}  // namespace
}  // namespace roomlight::bake
