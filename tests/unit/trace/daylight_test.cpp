// Skies given by a formula, as pictures: what a surface gets from the picture must be what it gets from the formula.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "photometry/sky_image.h"
#include "photometry/sky_luminance.h"
#include "trace/sky_distribution.h"

namespace roomlight {
namespace {

// Illuminance of a surface with normal n by the midpoint rule, even in altitude and bearing.
template <class Luminance>
double illuminance(Vec3 n, const Luminance& luminance) {
  constexpr int kRows = 1500, kColumns = 1200;
  double sum = 0;
  for (int row = 0; row < kRows; ++row) {
    const double altitude = std::numbers::pi * ((row + 0.5) / kRows - 0.5);
    for (int column = 0; column < kColumns; ++column) {
      const double bearing = 2 * std::numbers::pi * (column + 0.5) / kColumns;
      const Vec3 d{static_cast<float>(std::sin(bearing) * std::cos(altitude)), static_cast<float>(std::sin(altitude)),
                   static_cast<float>(-std::cos(bearing) * std::cos(altitude))};
      const double cosine = static_cast<double>(dot(d, n));
      if (cosine > 0) sum += luminance(d) * cosine * std::cos(altitude);
    }
  }
  return sum * 2 * std::numbers::pi * std::numbers::pi / (static_cast<double>(kRows) * kColumns);
}

SkyFunction cieSky(int type, Vec3 sun) {
  const double zenith = std::acos(static_cast<double>(sun.y));
  return [=](Vec3 d) {
    return cieSkyLuminance(type, static_cast<double>(d.y),
                           std::acos(std::clamp(static_cast<double>(dot(d, sun)), -1.0, 1.0)), zenith);
  };
}

// What the picture of a sky of 10 klx over ground of 700 cd/m² gives to roofs and facades.
void expectTheSameLight(const SkyFunction& exact) {
  const double scale = 10'000 / horizontalIlluminance(exact), ground = 700;
  Sky sky;
  sky.image = skyImage(exact, 10'000, Vec3(1));
  paintGround(sky.image, Vec3(static_cast<float>(ground * std::numbers::pi / 10'000)), Vec3(0), 0);
  sky.horizonEdge = true;
  const SkyDistribution picture(sky);
  for (const Vec3 n :
       {Vec3{0, 1, 0}, Vec3{1, 0, 0}, Vec3{-1, 0, 0}, Vec3{0, 0, -1}, Vec3{0, 0, 1}, normalize(Vec3{1, 1, 0})}) {
    const double expected = illuminance(n, [&](Vec3 d) { return d.y > 0 ? scale * exact(d) : ground; });
    const double measured = illuminance(n, [&](Vec3 d) { return static_cast<double>(luminance(picture.radiance(d))); });
    EXPECT_NEAR(measured, expected, 0.002 * expected) << n.x << ' ' << n.y << ' ' << n.z;
    if (n.y == 1) {
      EXPECT_NEAR(expected, 10'000, 10) << "what was asked for";
    }
  }
}

class CiePicture : public testing::TestWithParam<int> {};
TEST_P(CiePicture, lightsRoofsAndFacadesAsTheFormulaDoes) {
  expectTheSameLight(cieSky(GetParam(), normalize(Vec3{0.5f, 0.6f, -0.4f})));
}
INSTANTIATE_TEST_SUITE_P(Types, CiePicture, testing::Range(1, kCieSkyTypes + 1));

class PerezPicture : public testing::TestWithParam<double> {};
TEST_P(PerezPicture, lightsRoofsAndFacadesAsTheFormulaDoes) {
  const Vec3 sun = normalize(Vec3{0.5f, 0.4f, -0.4f});
  const PerezSky sky = perezSky({GetParam() * 120, 120}, std::acos(static_cast<double>(sun.y)));
  expectTheSameLight([=](Vec3 d) {
    return perezLuminance(sky, static_cast<double>(d.y),
                          std::acos(std::clamp(static_cast<double>(dot(d, sun)), -1.0, 1.0)));
  });
}
INSTANTIATE_TEST_SUITE_P(DirectOverDiffuse, PerezPicture, testing::Values(0, 0.2, 0.5, 1, 1.8, 3, 6, 8));

TEST(SkyPicture, hasAnEdgeAtTheHorizon) {
  Sky sky;
  sky.image = skyImage([](Vec3) { return 1.0; }, 10'000, Vec3(1));
  paintGround(sky.image, Vec3(static_cast<float>(50 * std::numbers::pi / 10'000)), Vec3(0), 0);
  sky.horizonEdge = true;
  const SkyDistribution picture(sky);
  for (const float up : {1e-4f, 1e-3f, 0.005f}) {
    const Vec3 d = normalize(Vec3{0.3f, up, -0.8f});
    EXPECT_NEAR(luminance(picture.radiance(d)), 10'000 / std::numbers::pi, 1);
    EXPECT_NEAR(luminance(picture.radiance({d.x, -d.y, d.z})), 50, 0.01);
  }
}

}  // namespace
}  // namespace roomlight
