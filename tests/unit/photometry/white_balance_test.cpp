// White balance against CIE figures and what it must leave alone.
#include "photometry/white_balance.h"

#include <gtest/gtest.h>

#include "photometry/colour_temperature.h"

namespace roomlight {
namespace {

void expectNear(Vec3 value, Vec3 expected, float tolerance) {
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(value[c], expected[c], tolerance) << "channel " << c;
}

TEST(WhiteBalance, whitesAreThoseOfTheCie) {
  const Vec2 d65 = whiteChromaticity(6504), d50 = whiteChromaticity(5003), a = whiteChromaticity(2856);
  EXPECT_NEAR(d65.x, 0.3127f, 3e-4f);
  EXPECT_NEAR(d65.y, 0.3290f, 3e-4f);
  EXPECT_NEAR(d50.x, 0.3457f, 3e-4f);
  EXPECT_NEAR(d50.y, 0.3585f, 3e-4f);
  EXPECT_NEAR(a.x, 0.4476f, 3e-3f);
  EXPECT_NEAR(a.y, 0.4074f, 3e-3f);
}

TEST(WhiteBalance, lampLightTurnsWhiteInFullAdaptation) {
  for (const double kelvin : {2200.0, 2700.0, 3000.0, 4000.0}) expectNear(whiteBalance(kelvin, 1).vector(blackBodyColour(kelvin)), {1, 1, 1}, 0.01f);
}

TEST(WhiteBalance, daylightAndNoAdaptationChangeNothing) {
  const Vec3 colour{0.7f, 0.2f, 0.4f};
  expectNear(whiteBalance(6504, 1).vector(colour), colour, 1e-3f);
  expectNear(whiteBalance(2700, 0).vector(colour), colour, 1e-3f);
}

TEST(WhiteBalance, partialAdaptationLeavesSomeWarmth) {
  const Vec3 lamp = blackBodyColour(2700), seen = whiteBalance(2700, 0.85).vector(lamp);
  EXPECT_GT(seen.x / seen.z, 1.1f);
  EXPECT_LT(seen.x / seen.z, 0.3f * lamp.x / lamp.z);
}

TEST(WhiteBalance, nearestWhiteFindsTheTemperatureBack) {
  for (const double kelvin : {1800.0, 2700.0, 3500.0}) EXPECT_NEAR(nearestWhiteK(blackBodyColour(kelvin)), kelvin, 0.01 * kelvin);
  EXPECT_NEAR(nearestWhiteK({1, 1, 1}), 6504, 30);
  EXPECT_EQ(nearestWhiteK({1, 0, 0}), kLowestWhiteK);
  EXPECT_EQ(nearestWhiteK({0, 0.1f, 1}), kHighestWhiteK);
}

// Fairchild, Color Appearance Models, CIECAM02: D of average surrounds.
TEST(WhiteBalance, adaptationGrowsWithLuminance) {
  EXPECT_NEAR(degreeOfAdaptation(0), 0.824, 1e-3);
  EXPECT_NEAR(degreeOfAdaptation(20), 0.858, 1e-3);
  EXPECT_NEAR(degreeOfAdaptation(318.31), 0.994, 1e-3);
}

}  // namespace
}  // namespace roomlight
