#include "trace/lights.h"

#include <gtest/gtest.h>

#include <numbers>

#include "photometry/spot.h"

namespace roomlight {
namespace {

double rad(double degrees) { return degrees * std::numbers::pi / 180; }

Lamp spot(double innerDeg, double outerDeg) {
  Lamp lamp;
  lamp.kind = LampKind::Spot;
  lamp.intensityCd = Vec3(1);
  lamp.innerConeRad = static_cast<float>(rad(innerDeg));
  lamp.outerConeRad = static_cast<float>(rad(outerDeg));
  return lamp;
}

// Lumens of a spot of 1 cd, by numerical integration of what the renderer uses.
double integratedFlux(const Lamp& lamp) {
  constexpr int kSteps = 400'000;
  const double widest = 1.02 * (1 - std::cos(static_cast<double>(lamp.outerConeRad)));  // of 1 - cos
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double h = widest * (i + 0.5) / kSteps;
    sum += luminance(lampIntensity(lamp, Vec3{static_cast<float>(std::sqrt(h * (2 - h))), static_cast<float>(h - 1), 0}));
  }
  return 2 * std::numbers::pi * sum * widest / kSteps;
}

TEST(Lights, fluxPerCandelaOfASpotIsTheIntegralOfItsFalloff) {
  const double cones[][2] = {{0, 45}, {12, 30}, {30, 30}, {89, 90}, {2, 2}, {0, 1}, {1, 1}, {0, 0.5}};
  for (const auto& [inner, outer] : cones) {
    const Lamp lamp = spot(inner, outer);
    const double expected = spotFluxPerCandela(std::cos(lamp.innerConeRad), std::cos(lamp.outerConeRad));
    EXPECT_NEAR(integratedFlux(lamp) / expected, 1, 0.005) << inner << " " << outer;
    EXPECT_EQ(luminance(lampIntensity(lamp, lamp.direction)), luminance(lamp.intensityCd)) << inner << " " << outer;
  }
}

TEST(Lights, aSunGivesItsIlluminanceWhateverItsSize) {
  for (const double diameterDeg : {0.0, 0.001, 0.01, 0.03, 0.1, 0.533, 5.0, 40.0}) {
    Scene scene;
    scene.suns.push_back({"sun", normalize(Vec3{1, 2, 3}), Vec3(1000), static_cast<float>(rad(diameterDeg) / 2)});
    const Lights lights(scene);
    constexpr int kSide = 64;
    double sum = 0;
    for (int i = 0; i < kSide * kSide; ++i) {
      const LightSample s = lights.sampleSun(0, {(static_cast<float>(i % kSide) + 0.5f) / kSide, (static_cast<float>(i / kSide) + 0.5f) / kSide});
      sum += luminance(s.radiance) * dot(s.wi, scene.suns[0].toLight);
    }
    EXPECT_NEAR(sum / (kSide * kSide), 1000, 0.1) << diameterDeg;
  }
}

TEST(Lights, aSunDiscIsSeenInsideItsAngleOnly) {
  for (const double halfDeg : {0.05, 0.2665, 20.0}) {
    Scene scene;
    scene.suns.push_back({"sun", {0, 1, 0}, Vec3(1000), static_cast<float>(rad(halfDeg))});
    const Lights lights(scene);
    float pdf = 0;
    const auto at = [](double angleDeg) { return Vec3{static_cast<float>(std::sin(rad(angleDeg))), static_cast<float>(std::cos(rad(angleDeg))), 0}; };
    const double solidAngle = 4 * std::numbers::pi * std::pow(std::sin(rad(halfDeg) / 2), 2);
    EXPECT_GT(luminance(lights.sunDisc(0, at(0.98 * halfDeg), pdf)), 0) << halfDeg;
    EXPECT_NEAR(pdf * solidAngle, 1, 1e-4) << halfDeg;
    EXPECT_EQ(luminance(lights.sunDisc(0, at(1.02 * halfDeg), pdf)), 0) << halfDeg;
    EXPECT_EQ(pdf, 0) << halfDeg;
  }
}

}  // namespace
}  // namespace roomlight
