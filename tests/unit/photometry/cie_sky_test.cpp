#include "photometry/sky_luminance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "photometry/sky_image.h"

namespace roomlight {
namespace {

constexpr double kPiD = std::numbers::pi;

SkyFunction sky(int type, double sunAltitudeDeg) {
  const double altitude = sunAltitudeDeg * kPiD / 180;
  const Vec3 sun{0, static_cast<float>(std::sin(altitude)), static_cast<float>(std::cos(altitude))};
  return [=](Vec3 d) {
    return cieSkyLuminance(type, static_cast<double>(d.y),
                           std::acos(std::clamp(static_cast<double>(dot(d, sun)), -1.0, 1.0)), kPiD / 2 - altitude);
  };
}

TEST(CieSky, isOneAtTheZenithWhereverTheSunStands) {
  for (int type = 1; type <= kCieSkyTypes; ++type) {
    for (const double zenith : {0.1, 0.8, 1.5}) EXPECT_NEAR(cieSkyLuminance(type, 1, zenith, zenith), 1, 1e-12) << type;
  }
}

TEST(CieSky, theTraditionalOvercastOneGivesSevenNinthsOfPiTimesItsZenith) {
  EXPECT_NEAR(horizontalIlluminance(sky(16, 30)), 7 * kPiD / 9, 1e-4);
  EXPECT_NEAR(horizontalIlluminance(sky(5, 30)), kPiD, 1e-4) << "type 5 is the uniform one";
}

TEST(CieSky, theStandardOvercastOneIsThreeTimesAsBrightAtTheZenithAsAtTheHorizon) {
  // Type 1 was fitted to keep the ratio of the traditional one: 1 / (1 + 4 exp(-0.7)) = 0.335.
  EXPECT_NEAR(cieSkyLuminance(1, 1e-6, 1, 1), 1 / (1 + 4 * std::exp(-0.7)), 1e-6);
  EXPECT_NEAR(cieSkyLuminance(16, 1e-9, 1, 1), 1 / 3.0, 1e-6);
}

// Type 12, the clear sky of low turbidity, is the older CIE clear sky: L = f(chi) (1 - exp(-0.32 / cos Z)) / (f(Z_s) (1
// - exp(-0.32))) with f = 0.91 + 10 exp(-3 chi) + 0.45 cos² chi (CIE S 003:1996).
TEST(CieSky, theClearOneIsThatOfTheOlderStandard) {
  const auto f = [](double chi) { return 0.91 + 10 * std::exp(-3 * chi) + 0.45 * std::cos(chi) * std::cos(chi); };
  for (const double cosZenith : {0.05, 0.3, 0.9}) {
    for (const double chi : {0.05, 0.5, 1.5, 2.5}) {
      const double expected = f(chi) * (1 - std::exp(-0.32 / cosZenith)) / (f(0.7) * (1 - std::exp(-0.32)));
      EXPECT_NEAR(cieSkyLuminance(12, cosZenith, chi, 0.7), expected, 0.001 * expected);
    }
  }
}

TEST(CieSky, onlySomeTypesHaveNoSunInThem) {
  for (int type = 1; type <= kCieSkyTypes; ++type) {
    const bool differs = std::abs(cieSkyLuminance(type, 0.5, 0.2, 1) - cieSkyLuminance(type, 0.5, 1.2, 1)) > 1e-9;
    EXPECT_EQ(dependsOnSun(type), differs) << type;
  }
  EXPECT_EQ(skyCover(5), SkyCover::Overcast);
  EXPECT_EQ(skyCover(16), SkyCover::Overcast);
  EXPECT_EQ(skyCover(10), SkyCover::Intermediate);
  EXPECT_EQ(skyCover(11), SkyCover::Clear);
}

TEST(CieSky, givesTheLuxOfTheModelForWantOfAMeasurement) {
  EXPECT_NEAR(skyHorizontalLux(SkyCover::Overcast, kPiD / 6), 10'800, 1e-6);
  EXPECT_NEAR(skyHorizontalLux(SkyCover::Clear, kPiD / 2), 16'300, 1e-6);
  EXPECT_NEAR(skyHorizontalLux(SkyCover::Intermediate, kPiD / 6), 22'800, 1e-6);
}

TEST(CieSky, darkensAsTwilightDoesAndIsNeverBlack) {
  const auto lux = [](double deg) { return skyHorizontalLux(SkyCover::Clear, deg * kPiD / 180); };
  EXPECT_NEAR(lux(-1e-6), lux(1e-6), 3);
  EXPECT_NEAR(lux(-6), 3.6, 0.2);
  for (double deg = 0; deg > -20; deg -= 0.5) EXPECT_LE(lux(deg - 0.5), lux(deg));
  EXPECT_EQ(lux(-40), kNightLux);
}

}  // namespace
}  // namespace roomlight
