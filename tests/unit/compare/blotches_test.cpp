#include "compare/perceived_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace roomlight {
namespace {

constexpr int kSide = 256;

Image wall(float cdM2 = 10) {
  Image image(kSide, kSide);
  for (Vec3& p : image.pixels) p = Vec3(cdM2);
  return image;
}

// Times 1 + amplitude sin in both directions.
Image rippled(float period, float amplitude) {
  Image image = wall();
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x)
      image.at(x, y) *= 1 + amplitude * std::sin(2 * kPi * static_cast<float>(x) / period) *
                                std::sin(2 * kPi * static_cast<float>(y) / period);
  }
  return image;
}

Image noisy(unsigned seed, float deviation) {
  Image image = wall();
  std::mt19937 random(seed);
  std::normal_distribution<float> noise(1, deviation);
  for (Vec3& p : image.pixels) p *= noise(random);
  return image;
}

TEST(Blotches, areWhatIsWrongBetween4And32Pixels) {
  EXPECT_EQ(blotches(wall(), wall(), wall()).blotchesPercent, 0);
  // Root mean square of the product of two sines is half of the amplitude; a Gaussian of 4 pixels leaves exp(-(2 pi 4 /
  // 48)^2) of it, that of 32 nothing.
  const double left = std::exp(-std::pow(2 * 3.14159265 * 4 / 48, 2));
  EXPECT_NEAR(blotches(wall(), wall(), rippled(48, 0.04f)).blotchesPercent, 100 * 0.02 * left, 0.1);
  EXPECT_LT(blotches(wall(), wall(), rippled(8, 0.04f)).blotchesPercent, 0.05);
  EXPECT_GT(blotches(wall(), wall(), rippled(12, 0.04f)).grainPercent, 0.4);
  EXPECT_LT(blotches(wall(), wall(), wall(11)).blotchesPercent, 1e-3);  // a matter of the mean
}

TEST(Blotches, noiseOfReferencesDropsOut) {
  const double clean = blotches(wall(), wall(), rippled(48, 0.04f)).blotchesPercent;
  double mean = 0;
  for (unsigned i = 0; i < 8; ++i)
    mean += blotches(noisy(2 * i + 1, 0.2f), noisy(2 * i + 2, 0.2f), rippled(48, 0.04f)).blotchesPercent / 8;
  EXPECT_NEAR(mean, clean, 0.15);  // with one reference it is 1.4 times as much
}

// A thing before a void: what is black says nothing of what is lit.
TEST(Blotches, areThoseOfWhatIsLit) {
  Image reference = wall(), picture = rippled(48, 0.04f);
  const double all = blotches(reference, reference, picture).blotchesPercent;
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      if (y >= kSide / 3) reference.at(x, y) = picture.at(x, y) = {};
    }
  }
  const Blotches found = blotches(reference, reference, picture);
  EXPECT_NEAR(found.blotchesPercent, all, 0.3 * all);
  EXPECT_NEAR(found.judgedShare, 0.3, 0.05);
  EXPECT_EQ(blotches(Image(8, 8), Image(8, 8), Image(8, 8)).judgedShare, 0);
}

TEST(Blotches, edgesAndLampsAreNotJudged) {
  Image reference = wall(), picture = wall();
  for (int y = 100; y < 110; ++y) {
    for (int x = 100; x < 110; ++x) reference.at(x, y) = Vec3(1000), picture.at(x, y) = Vec3(500);
  }
  const Blotches found = blotches(reference, reference, picture);
  EXPECT_LT(found.blotchesPercent, 1e-3);
  EXPECT_EQ(found.band.values[105 * kSide + 105], kNotJudged);
  EXPECT_TRUE(isBlack(bandPicture(found).at(105, 105)));
}

}  // namespace
}  // namespace roomlight
