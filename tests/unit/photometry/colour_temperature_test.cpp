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
}  // namespace roomlight
