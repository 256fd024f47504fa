#include "compare/compare.h"

#include <gtest/gtest.h>

#include "base/random.h"
#include "base/tone.h"
#include "compare/perceived_error.h"

namespace roomlight {
namespace {

// A smooth room-like gradient with some texture, 1..200 cd/m².
Image gradient(int width = 64, int height = 48) {
  Image image(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const float v =
          20 + 60 * static_cast<float>(x) / static_cast<float>(width) + 15 * std::sin(static_cast<float>(y) * 0.7f);
      image.at(x, y) = {v, v * 0.8f, v * 0.6f};
    }
  }
  return image;
}

Image scaled(Image image, float factor) {
  for (Vec3& p : image.pixels) p *= factor;
  return image;
}

Image noisy(Image image, float amount) {
  for (size_t i = 0; i < image.pixels.size(); ++i) {
    Rng rng(i, 0, 9);
    image.pixels[i] *= 1 + amount * (2 * rng.uniform() - 1);
  }
  return image;
}

TEST(Compare, aPictureEqualsItself) {
  const Report r = compare(gradient(), gradient()).value();
  EXPECT_EQ(r.mse, 0);
  EXPECT_EQ(r.relMse, 0);
  EXPECT_NEAR(r.ssim, 1, 1e-6);
  EXPECT_EQ(r.flip, 0);
  EXPECT_EQ(r.meanLuminanceErrorPercent, 0);
}

TEST(Compare, mseIsThatOfTheEncodedPicturesUnderTheReferencesExposure) {
  // Two constants: the reference's exposure maps it to 18 % grey, the picture at twice that to 36 %.
  Image a(8, 8), b(8, 8);
  for (Vec3& p : a.pixels) p = Vec3(40);
  for (Vec3& p : b.pixels) p = Vec3(80);
  const double d = static_cast<double>(srgbEncode(0.36f)) - static_cast<double>(srgbEncode(0.18f));
  EXPECT_NEAR(compare(a, b).value().mse, d * d, 1e-6);
}

TEST(Compare, twoReferencesTellTheirNoiseFromThePicturesError) {
  const Image truth = gradient(160, 120), picture = scaled(truth, 1.1f);
  Image other = truth;
  for (size_t i = 0; i < other.pixels.size(); ++i) {
    Rng rng(i, 1, 10);
    other.pixels[i] *= 1 + 0.15f * (2 * rng.uniform() - 1);
  }
  const double exact = compare(truth, picture).value().mse;
  const Report r = compare(noisy(truth, 0.15f), other, picture).value();
  EXPECT_GT(r.mse, 1.2 * exact);
  EXPECT_NEAR(r.mseBeyondNoise.value(), exact, 0.1 * exact);
  EXPECT_FALSE(compare(truth, gradient(8, 8), picture).ok());
}

TEST(Compare, mseDoesNotDependOnTheUnitOfTheScene) {
  const Image a = gradient(), b = noisy(a, 0.2f);
  EXPECT_NEAR(compare(a, b).value().mse, compare(scaled(a, 1000), scaled(b, 1000)).value().mse, 1e-7);
  EXPECT_NEAR(compare(a, b).value().relMse, compare(scaled(a, 1000), scaled(b, 1000)).value().relMse, 1e-7);
}

TEST(Compare, lampsClipToTheSameWhite) {
  Image a = gradient(), b = a;
  a.at(3, 3) = Vec3(1e5f);
  b.at(3, 3) = Vec3(2e5f);
  EXPECT_NEAR(compare(a, b).value().mse, 0, 1e-12);
}

TEST(Compare, relativeErrorOfAConstantFactorIsItsSquare) {
  Image a(8, 8), b(8, 8);
  for (Vec3& p : a.pixels) p = Vec3(40);
  for (Vec3& p : b.pixels) p = Vec3(44);
  EXPECT_NEAR(compare(a, b).value().relMse, 0.01 / 1.01, 1e-6);  // (0.1 r)² / (r² + 0.01 r²)
}

TEST(Compare, meanLuminanceErrorIsSigned) {
  const Image a = gradient();
  EXPECT_NEAR(compare(a, scaled(a, 1.05f)).value().meanLuminanceErrorPercent, 5, 1e-3);
  EXPECT_NEAR(compare(a, scaled(a, 0.9f)).value().meanLuminanceErrorPercent, -10, 1e-3);
}

TEST(Compare, everyMeasureRisesWithNoise) {
  const Image a = gradient();
  const Report little = compare(a, noisy(a, 0.05f)).value(), much = compare(a, noisy(a, 0.4f)).value();
  EXPECT_GT(little.mse, 0);
  EXPECT_LT(little.mse, much.mse);
  EXPECT_LT(little.relMse, much.relMse);
  EXPECT_GT(little.ssim, much.ssim);
  EXPECT_LT(little.flip, much.flip);
}

TEST(Compare, ssimOfUnrelatedNoiseIsNearZeroAndOfConstantsFollowsTheFormula) {
  Plane a(64, 64), b(64, 64), grey(64, 64), light(64, 64);
  Rng rng(1, 2, 3);
  for (size_t i = 0; i < a.values.size(); ++i) {
    a.values[i] = rng.uniform(), b.values[i] = rng.uniform();
    grey.values[i] = 0.25f, light.values[i] = 0.5f;
  }
  EXPECT_LT(structuralSimilarity(a, b), 0.1);
  // Without variance only the luminance term is left: (2 ma mb + C1)/(ma² + mb² + C1).
  EXPECT_NEAR(structuralSimilarity(grey, light), (0.25 + 1e-4) / (0.0625 + 0.25 + 1e-4), 1e-4);
}

TEST(Compare, wrongPairsAreErrorsThatSayWhy) {
  const Image a = gradient();
  const auto sizes = compare(a, gradient(63, 48));
  ASSERT_FALSE(sizes.ok());
  EXPECT_NE(sizes.error().find("64 x 48"), std::string::npos) << sizes.error();
  EXPECT_NE(sizes.error().find("63 x 48"), std::string::npos) << sizes.error();
  Image bad = a;
  bad.at(5, 7).y = std::numeric_limits<float>::quiet_NaN();
  const auto nan = compare(a, bad);
  ASSERT_FALSE(nan.ok());
  EXPECT_NE(nan.error().find("(5, 7)"), std::string::npos) << nan.error();
  EXPECT_FALSE(compare(bad, a).ok());
  EXPECT_FALSE(compare(Image(4, 4), Image(4, 4)).ok()) << "black reference";
  EXPECT_FALSE(compare(Image(), Image()).ok());
}

TEST(Compare, differencePictureIsGreyWhereEqualRedWhereBrighterBlueWhereDarker) {
  const Image a = gradient();
  Image b = a;
  b.at(1, 1) *= 3.0f;
  b.at(2, 2) *= 0.2f;
  const Image d = differencePicture(a, b);
  EXPECT_TRUE(d.at(0, 0) == Vec3(0.5f));
  EXPECT_GT(d.at(1, 1).x, d.at(1, 1).z);
  EXPECT_GT(d.at(2, 2).z, d.at(2, 2).x);
}

}  // namespace
}  // namespace roomlight
