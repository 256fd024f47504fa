// Colours of black bodies and of white against CIE figures.
#include "photometry/colour_temperature.h"

#include <gtest/gtest.h>

namespace roomlight {
namespace {

// Points of the Planckian locus (CIE 15:2004 and Kim et al. 2002's table): 2856 K is CIE illuminant A.
TEST(ColourTemperature, liesOnThePlanckianLocus) {
  const struct {
    double kelvin;
    float x, y;
  } known[] = {{2000, 0.5267f, 0.4133f},
               {2855.5, 0.4476f, 0.4074f},
               {4000, 0.3805f, 0.3768f},
               {6500, 0.3135f, 0.3237f},
               {10000, 0.2807f, 0.2884f}};
  for (const auto& k : known) {
    const Vec2 c = blackBodyChromaticity(k.kelvin);
    EXPECT_NEAR(c.x, k.x, 0.003) << k.kelvin;
    EXPECT_NEAR(c.y, k.y, 0.003) << k.kelvin;
  }
}

TEST(ColourTemperature, hasLuminanceOneAndTurnsFromRedToBlue) {
  float ratio = 1e9f;
  for (double kelvin = kLowestKelvin; kelvin <= kHighestKelvin; kelvin *= 1.2) {
    const Vec3 c = blackBodyColour(kelvin);
    EXPECT_NEAR(luminance(c), 1, 1e-5) << kelvin;
    EXPECT_GE(std::min({c.x, c.y, c.z}), 0) << kelvin;
    EXPECT_LT(c.x / std::max(c.z, 1e-4f), ratio * 1.0001f) << kelvin;
    ratio = c.x / std::max(c.z, 1e-4f);
  }
}

}  // namespace

// White balance against CIE figures and what it must leave alone.
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
