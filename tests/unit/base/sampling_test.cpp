#include "base/sampling.h"

#include <gtest/gtest.h>

#include <functional>
#include <vector>

#include "base/ggx.h"
#include "base/random.h"
#include "unit/base/chi_square.h"

namespace roomlight {
namespace {

constexpr int kSamples = 400'000, kPolar = 32, kAzimuth = 32;

// Chi-square of directions against a density per steradian, on a grid uniform in cos(theta) and azimuth.
::testing::AssertionResult directionsFit(const std::function<Vec3(Vec2)>& sample,
                                         const std::function<double(Vec3)>& pdf) {
  std::vector<double> counts(kPolar * kAzimuth), expected(kPolar * kAzimuth);
  Rng rng(11, 12, 13);
  for (int i = 0; i < kSamples; ++i) {
    const Vec3 d = sample(rng.uniform2());
    if (std::abs(length(d) - 1) > 1e-4f) return ::testing::AssertionFailure() << "not a unit vector";
    const double turn = std::atan2(static_cast<double>(d.y), static_cast<double>(d.x)) / (2 * M_PI) + 0.5;
    const int p = std::clamp(static_cast<int>((static_cast<double>(d.z) + 1) / 2 * kPolar), 0, kPolar - 1);
    const int a = std::clamp(static_cast<int>(turn * kAzimuth), 0, kAzimuth - 1);
    counts[static_cast<size_t>(p * kAzimuth + a)]++;
  }
  // The density integrated over each cell by 16 x 16 midpoints.
  constexpr int kFine = 16;
  for (int p = 0; p < kPolar * kFine; ++p) {
    for (int a = 0; a < kAzimuth * kFine; ++a) {
      const double z = (p + 0.5) / (kPolar * kFine) * 2 - 1, phi = ((a + 0.5) / (kAzimuth * kFine) - 0.5) * 2 * M_PI;
      const double r = std::sqrt(1 - z * z);
      const Vec3 d{static_cast<float>(r * std::cos(phi)), static_cast<float>(r * std::sin(phi)), static_cast<float>(z)};
      const double cell = 4 * M_PI / (kPolar * kFine * kAzimuth * kFine);
      expected[static_cast<size_t>((p / kFine) * kAzimuth + a / kFine)] += pdf(d) * cell * kSamples;
    }
  }
  return testing::fits(counts, expected);
}

TEST(Sampling, sphereIsUniform) {
  EXPECT_TRUE(directionsFit(sampleSphere, [](Vec3) { return 1 / (4 * M_PI); }));
}

TEST(Sampling, cosineHemisphereFollowsItsDensity) {
  EXPECT_TRUE(
      directionsFit(sampleCosineHemisphere, [](Vec3 d) { return static_cast<double>(cosineHemispherePdf(d.z)); }));
}

TEST(Sampling, coneFollowsItsDensity) {
  for (float cosHalf : {-0.5f, 0.25f, 0.75f}) {
    EXPECT_TRUE(
        directionsFit([=](Vec2 u) { return sampleCone(u, 1 - cosHalf); },
                      [=](Vec3 d) { return d.z >= cosHalf ? static_cast<double>(conePdf(1 - cosHalf)) : 0.0; }));
  }
}

// The reflection of wo about a visible normal has density G1(wo) D(h) / (4 cos wo) (Walter 2007, Heitz 2018).
TEST(Sampling, visibleNormalsFollowTheirDensity) {
  for (float alpha : {0.3f, 0.7f}) {
    for (float cosO : {0.95f, 0.4f}) {
      const Vec3 wo{std::sqrt(1 - cosO * cosO), 0, cosO};
      EXPECT_TRUE(directionsFit([&](Vec2 u) { return sampleVisibleNormal(wo, alpha, u); },
                                [&](Vec3 h) -> double {
                                  if (h.z <= 0) return 0;
                                  return static_cast<double>(ggxG1(wo.z, alpha) * std::max(0.0f, dot(wo, h)) *
                                                             ggxD(h.z, alpha) / wo.z);
                                }))
          << "alpha " << alpha << ", cos " << cosO;
    }
  }
}

TEST(Sampling, discIsUniformInAreaAndHasNoPreferredDirection) {
  std::vector<double> rings(16), sectors(16);
  Rng rng(1, 1, 1);
  for (int i = 0; i < kSamples; ++i) {
    const Vec2 d = sampleDisc(rng.uniform2());
    const double r2 = static_cast<double>(d.x) * d.x + static_cast<double>(d.y) * d.y;
    ASSERT_LE(r2, 1.00001);
    rings[std::min<size_t>(15, static_cast<size_t>(r2 * 16))]++;
    const double turn = std::atan2(static_cast<double>(d.y), static_cast<double>(d.x)) / (2 * M_PI) + 0.5;
    sectors[std::min<size_t>(15, static_cast<size_t>(turn * 16))]++;
  }
  EXPECT_TRUE(testing::fitsUniform(rings));
  EXPECT_TRUE(testing::fitsUniform(sectors));
}

TEST(Sampling, triangleIsUniformInArea) {
  // Split by the medians' midpoint triangle scheme: four congruent triangles take a quarter each.
  std::vector<double> counts(4);
  double sum1 = 0, sum2 = 0, product = 0;
  Rng rng(2, 2, 2);
  for (int i = 0; i < kSamples; ++i) {
    const Vec2 b = sampleTriangle(rng.uniform2());
    ASSERT_GE(b.x, 0);
    ASSERT_GE(b.y, 0);
    ASSERT_LE(b.x + b.y, 1.00001f);
    counts[b.x > 0.5f ? 1 : b.y > 0.5f ? 2 : b.x + b.y < 0.5f ? 3 : 0]++;
    sum1 += b.x, sum2 += b.y, product += static_cast<double>(b.x) * b.y;
  }
  EXPECT_TRUE(testing::fitsUniform(counts));
  EXPECT_NEAR(sum1 / kSamples, 1.0 / 3, 2e-3);
  EXPECT_NEAR(sum2 / kSamples, 1.0 / 3, 2e-3);
  EXPECT_NEAR(product / kSamples, 1.0 / 12, 1e-3);  // second mixed moment of the uniform triangle
}

TEST(Sampling, misWeightsOfTwoStrategiesSumToOne) {
  EXPECT_FLOAT_EQ(misWeight(0.3f, 2) + misWeight(2, 0.3f), 1);
  EXPECT_EQ(misWeight(0, 0), 0);
}

}  // namespace
}  // namespace roomlight
