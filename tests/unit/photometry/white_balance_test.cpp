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

TEST(WhiteBalance, coloursOfWhitesAreThoseOfBlackBodiesAndDaylight) {
  for (const double kelvin : {2200.0, 2700.0, 3000.0}) expectNear(whiteColour(kelvin), blackBodyColour(kelvin), 0.01f);
  expectNear(whiteColour(6504), {1, 1, 1}, 2e-3f);
  for (const double kelvin : {1800.0, 4500.0, 12000.0}) EXPECT_NEAR(luminance(whiteColour(kelvin)), 1, 1e-3f);
}

TEST(WhiteBalance, nearestWhiteFindsTheTemperatureBack) {
  for (const double kelvin : {1800.0, 2700.0, 3500.0})
    EXPECT_NEAR(nearestWhiteK(blackBodyColour(kelvin)), kelvin, 0.01 * kelvin);
  EXPECT_NEAR(nearestWhiteK({1, 1, 1}), 6504, 30);
  EXPECT_EQ(nearestWhiteK({1, 0, 0}), kLowestWhiteK);
  EXPECT_EQ(nearestWhiteK({0, 0.1f, 1}), kHighestWhiteK);
}

}  // namespace
}  // namespace roomlight
