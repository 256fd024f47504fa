#include "measure/glare.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/rooms.h"

namespace roomlight {
namespace {

const Vec3 kView{0, 0, -1};

Vec3 towards(double degreesRight, double degreesUp) {
  const double a = degreesRight * 0.017453292519943295, b = degreesUp * 0.017453292519943295;
  return {static_cast<float>(std::sin(a) * std::cos(b)), static_cast<float>(std::sin(b)),
          static_cast<float>(-std::cos(a) * std::cos(b))};
}

TEST(PositionIndex, isOneOnTheLineOfSight) {
  EXPECT_NEAR(positionIndex(kView, kView), 1, 1e-6);
  EXPECT_NEAR(positionIndex(towards(0.01, 0.01), kView), 1, 1e-3);
  EXPECT_NEAR(positionIndex(towards(0, -0.01), kView), 1, 1e-3);
}

// By hand: straight up tau = 0, ln p = (35.2 - 1.22) 30e-3 + 21e-5 · 900 = 1.2084; to the side tau = 90,
// ln p = (35.2 - 28.7001) 30e-3 + (21 + 24.0003 - 24.0003) 1e-5 · 900 = 0.3840.
TEST(PositionIndex, agreesWithHandComputation) {
  EXPECT_NEAR(positionIndex(towards(0, 30), kView), std::exp(1.2084), 1e-3);
  EXPECT_NEAR(positionIndex(towards(30, 0), kView), std::exp(0.3840), 1e-3);
  EXPECT_NEAR(positionIndex(towards(0, -26.565051), kView), 1.4, 1e-4);
  EXPECT_NEAR(positionIndex(towards(0, -45), kView), 2.2, 1e-4);
  EXPECT_EQ(positionIndex(towards(0, 80), kView), 16);
  EXPECT_TRUE(std::isinf(positionIndex(towards(180, 10), kView)));
}

TEST(PositionIndex, isTheSameToBothSidesAndTurnsWithTheHead) {
  EXPECT_FLOAT_EQ(static_cast<float>(positionIndex(towards(25, 15), kView)),
                  static_cast<float>(positionIndex(towards(-25, 15), kView)));
  const Vec3 east{1, 0, 0}, d = towards(25, 15);
  EXPECT_NEAR(positionIndex({-d.z, d.y, d.x}, east), positionIndex(d, kView), 1e-4);
}

TEST(Ugr, ofOneSourceByHand) {
  // 0.25 / 20 · 5000² · 0.01 = 3125: 8 lg 3125 = 27.96.
  const GlareSource s{kView, 5000, 0.01};
  EXPECT_NEAR(ugr({&s, 1}, kView, 20), 8 * std::log10(3125.0), 1e-6);
  // Twice as many of the same are 8 lg 2 more.
  const GlareSource two[] = {s, s};
  EXPECT_NEAR(ugr(two, kView, 20) - ugr({&s, 1}, kView, 20), 8 * std::log10(2.0), 1e-6);
  EXPECT_TRUE(std::isinf(ugr({}, kView, 20)));
}

TEST(Ugr, smallSourcesCountByTheirIntensity) {
  const GlareSource s = smallSource(kView, 100, 2);
  EXPECT_NEAR(s.luminanceCdM2 * s.luminanceCdM2 * s.solidAngleSr, 200 * 100.0 * 100 / 4, 1e-6);
}

// A square of 0.6 m that faces the eye 3 m away, exactly: its solid angle 4 atan(a² / (4 d sqrt(d² + a²/2))), its light
// on the eye π L F.
TEST(SeenLamps, measureASquareExactly) {
  Scene scene;
  test::addRectangle(scene, {-0.3f, -0.3f, -3}, {0.6f, 0, 0}, {0, 0.6f, 0},
                     test::addMaterial(scene, test::lambertian(0, 1000)), 3);
  const RayScene rays(scene);
  const SeenLamps seen = seenLamps(rays, {0, 0, 0}, kView);
  ASSERT_EQ(seen.sources.size(), 1u);
  const double half = 0.3, d = 3, omega = 4 * std::asin(half * half / (half * half + d * d));
  EXPECT_NEAR(seen.sources[0].solidAngleSr, omega, 1e-4 * omega);
  EXPECT_NEAR(seen.sources[0].luminanceCdM2, 1000, 0.01);
  EXPECT_NEAR(static_cast<double>(dot(seen.sources[0].direction, kView)), 1, 1e-4);
  const double x = half / d, quadrant = x / std::sqrt(1 + x * x) * std::atan(x / std::sqrt(1 + x * x));
  EXPECT_NEAR(seen.directLux, 1000 * 4 * quadrant, 1e-3 * seen.directLux);
  // From behind it is dark.
  EXPECT_TRUE(seenLamps(rays, {0, 0, -6}, {0, 0, 1}).sources.empty());
}

TEST(SeenLamps, lessIsSeenBehindAnEdge) {
  Scene scene;
  test::addRectangle(scene, {-0.3f, -0.3f, -3}, {0.6f, 0, 0}, {0, 0.6f, 0},
                     test::addMaterial(scene, test::lambertian(0, 1000)));
  test::addRectangle(scene, {0, -2, -2}, {2, 0, 0}, {0, 4, 0}, test::addMaterial(scene, test::lambertian(0.5f)));
  const RayScene rays(scene);
  const SeenLamps seen = seenLamps(rays, {0, 0, 0}, kView);
  ASSERT_EQ(seen.sources.size(), 1u);
  const double omega = 4 * std::asin(0.09 / 9.09);
  EXPECT_NEAR(seen.sources[0].solidAngleSr, omega / 2, 0.01 * omega);
  EXPECT_LT(seen.sources[0].direction.x, 0);
}

TEST(SeenLamps, aPointLampIsASmallSource) {
  Scene scene;
  test::addRectangle(scene, {-5, -1, -5}, {0, 0, 10}, {10, 0, 0}, test::addMaterial(scene, test::lambertian(0.5f)));
  scene.lamps.push_back(test::pointLamp({0, 0, -2}, 100));
  const RayScene rays(scene);
  const SeenLamps seen = seenLamps(rays, {0, 0, 0}, kView);
  ASSERT_EQ(seen.sources.size(), 1u);
  EXPECT_NEAR(seen.sources[0].solidAngleSr, 0.005 / 4, 1e-9);
  EXPECT_NEAR(seen.sources[0].luminanceCdM2, 20000, 0.1);
  EXPECT_NEAR(seen.directLux, 25, 1e-3);
}

// A Lambertian panel of 1 x 0.5 m and 1000 cd that faces the eye, given by its web.
TEST(SeenLamps, aLuminaireWithAnOpeningIsAsLargeAsThat) {
  Scene scene;
  test::addRectangle(scene, {-5, -1, -5}, {0, 0, 10}, {10, 0, 0}, test::addMaterial(scene, test::lambertian(0.5f)));
  PhotometricWeb web;
  web.cRad = {0, 2 * kPi};
  for (int i = 0; i <= 90; ++i) web.gammaRad.push_back(static_cast<float>(i) * kPi / 180);
  for (int plane = 0; plane < 2; ++plane) {
    for (const float gamma : web.gammaRad) web.candela.push_back(1000 * std::max(0.0f, std::cos(gamma)));
  }
  web.sizeC0M = 1, web.sizeC90M = 0.5f;
  sumUp(web);
  Lamp lamp = test::pointLamp({0, 0, -4}, 1000);
  lamp.direction = {0, 0, 1}, lamp.up = {1, 0, 0};
  lamp.web = std::make_shared<const PhotometricWeb>(web), lamp.extended = true;
  scene.lamps.push_back(lamp);
  const RayScene rays(scene);
  const SeenLamps seen = seenLamps(rays, {0, 0, 0}, kView);
  ASSERT_EQ(seen.sources.size(), 1u);
  EXPECT_NEAR(seen.sources[0].luminanceCdM2, 2000, 40);
  EXPECT_NEAR(seen.sources[0].solidAngleSr, 0.5 / 16, 1e-6);
  EXPECT_NEAR(seen.directLux, 1000 / 16.0, 2);
}

}  // namespace
}  // namespace roomlight
