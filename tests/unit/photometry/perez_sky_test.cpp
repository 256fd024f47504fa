#include "photometry/sky_luminance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace roomlight {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

// Worked by hand: Z = 60 degrees, 1367 W/m² outside, 2 cm of water.
TEST(PerezSky, hasTheParametersOfAWorkedExample) {
  const PerezSky sky = perezSky({500, 200}, 60 * kDegree);
  EXPECT_NEAR(airMass(60 * kDegree), 1.99429, 1e-4);
  EXPECT_NEAR(sky.clearness, 2.1387, 1e-3);
  EXPECT_NEAR(sky.brightness, 0.291776, 1e-4);
  EXPECT_EQ(sky.clearnessClass, 4);
  EXPECT_NEAR(sky.a, -0.99247, 1e-4);
  EXPECT_NEAR(sky.diffuseEfficacy, 130.457, 0.01);
  EXPECT_NEAR(sky.directEfficacy, 91.864, 0.01);
}

TEST(PerezSky, classesGoFromOvercastToClear) {
  int before = -1;
  for (const double direct : {0.0, 30.0, 70.0, 120.0, 250.0, 400.0, 800.0, 1100.0}) {
    const PerezSky sky = perezSky({direct, 120}, 40 * kDegree);
    EXPECT_GE(sky.clearnessClass, before);
    before = sky.clearnessClass;
  }
  EXPECT_EQ(perezSky({0, 120}, 0.7).clearnessClass, 0);
  EXPECT_EQ(before, 7);
}

// The paper of 1990 finds 100 to 150 lm/W of diffuse light, 80 to 110 of direct light by a sun that is not low.
TEST(PerezSky, efficaciesAreThoseOfDaylight) {
  for (const double zenith : {10.0, 30.0, 50.0, 65.0}) {
    for (const double direct : {0.0, 30.0, 100.0, 300.0, 600.0, 900.0}) {
      const PerezSky sky = perezSky({direct, direct > 500 ? 90.0 : 220.0}, zenith * kDegree);
      EXPECT_GT(sky.diffuseEfficacy, 100);
      EXPECT_LT(sky.diffuseEfficacy, 155);
      if (direct >= 100) {
        EXPECT_GT(sky.directEfficacy, 78);
        EXPECT_LT(sky.directEfficacy, 112);
      }
    }
  }
}

// Luminances of the equation, worked out apart from this code with the sun 50 degrees from the zenith.
TEST(PerezSky, glowsAboutAClearSunAndDarkensToAnOvercastHorizon) {
  const double z = 50 * kDegree;
  const PerezSky overcast = perezSky({0, 176.00028}, z);  // brightness 0.2
  EXPECT_NEAR(perezLuminance(overcast, 1, z) / perezLuminance(overcast, 0.1, std::numbers::pi / 2), 1.65707, 1e-4);
  const PerezSky clear = perezSky({900, 88.00014}, z);  // brightness 0.1
  ASSERT_EQ(clear.clearnessClass, 7);
  EXPECT_NEAR(perezLuminance(clear, std::cos(z), 0.05) / perezLuminance(clear, 1, z), 13.53324, 1e-3);
  EXPECT_NEAR(perezLuminance(clear, 0.1, 2) / perezLuminance(clear, 1, z), 3.20645, 1e-3);
}

TEST(PerezSky, isFiniteAndNotNegativeForAnySunAndIrradiance) {
  for (const double zenith : {0.0, 0.5, 1.0, 1.5, 1.57, 3.0}) {
    for (const double direct : {0.0, 1.0, 20.0, 100.0, 500.0, 2000.0}) {
      for (const double diffuse : {0.01, 1.0, 50.0, 300.0, 2000.0}) {
        const PerezSky sky = perezSky({direct, diffuse}, zenith);
        for (const double c : {1e-6, 0.01, 0.1, 0.5, 1.0}) {
          for (const double angle : {0.0, 0.3, 1.5, 3.14}) {
            const double l = perezLuminance(sky, c, angle);
            EXPECT_TRUE(std::isfinite(l) && l >= 0) << zenith << ' ' << direct << ' ' << diffuse;
          }
        }
        EXPECT_TRUE(std::isfinite(sky.directEfficacy) && std::isfinite(sky.diffuseEfficacy));
      }
    }
  }
}

}  // namespace
}  // namespace roomlight
