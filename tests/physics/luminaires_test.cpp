// Luminaires with photometric webs against closed forms, as points and as large as their opening.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "reference/path_tracer.h"
#include "support/record.h"
#include "support/rooms.h"
#include "support/webs.h"

namespace roomlight {
namespace {

double measure(const Scene& scene, Vec3 p, Vec3 n, int samples) {
  const RayScene rays(scene);
  const Lights lights(scene);
  return luminance(measureIlluminance(rays, lights, p, n, samples, 7).illuminanceLux);
}

Scene blackFloor(const Lamp& lamp) {
  Scene scene;
  test::addRectangle(scene, {-3, 0, -3}, {0, 0, 6}, {6, 0, 0}, test::addMaterial(scene, test::lambertian(0)));
  scene.lamps.push_back(lamp);
  return scene;
}

// 1000 cd straight down at 3 m: 1000 h² / d⁴.
TEST(Luminaires, aLambertianWebLightsTheFloor) {
  const Scene scene = blackFloor(test::webLamp({0, 3, 0}, test::lambertianWeb(1000)));
  const std::tuple<float, float, double> places[] = {{0.0f, 0.0f, 111.11}, {0.5f, 0.0f, 105.21}, {1.0f, 0.0f, 90.02},
                                                     {1.5f, 0.0f, 71.11},  {1.0f, 1.0f, 74.36},  {1.5f, 1.5f, 49.39}};
  for (const auto& [x, z, lux] : places) {
    const double measured = measure(scene, {x, 0, z}, {0, 1, 0}, 64);
    test::record("Lambertian web of 1000 cd at 3 m, illuminance on the floor, lx", fmt::format("({}, {}) m", x, z),
                 "path", lux, measured);
    EXPECT_NEAR(measured, lux, 1e-3 * lux) << x << " " << z;
  }
}

// Where it points: C0 along `up`, C90 counter-clockwise from it seen from above, whatever the luminaire's tilt.
TEST(Luminaires, aWebIsTurnedWithItsLamp) {
  const auto web =
      test::makeWeb([](float c, float g) { return 100 + 50 * std::cos(c) + 20 * std::sin(c) + 10 * g; }, 180, 5);
  Lamp lamp = test::webLamp({0, 2, 0}, web);
  // Seen from above with -z ahead, +x to -z is counter-clockwise.
  EXPECT_NEAR(luminance(lampIntensity(lamp, {1, 0, 0})), 150 + 5 * kPi, 0.01);
  EXPECT_NEAR(luminance(lampIntensity(lamp, {0, 0, -1})), 120 + 5 * kPi, 0.01);
  EXPECT_NEAR(luminance(lampIntensity(lamp, {0, 0, 1})), 80 + 5 * kPi, 0.01);
  lamp.direction = {0, 0, -1}, lamp.up = {0, 1, 0};  // as a node of glTF without rotation
  EXPECT_NEAR(luminance(lampIntensity(lamp, {0, 1, 0})), 150 + 5 * kPi, 0.01);
  EXPECT_NEAR(luminance(lampIntensity(lamp, {-1, 0, 0})), 120 + 5 * kPi, 0.01);
}

// As large as its opening, a Lambertian web is a luminous panel from any distance.
TEST(Luminaires, aLambertianWebWithAnOpeningIsAPanel) {
  const double square = 4 * 100 * std::atan(1 / std::sqrt(5.0)) / std::sqrt(5.0);
  const Scene panel = blackFloor(test::webLamp({0, 1, 0}, test::lambertianWeb(100, 1, 1)));
  const double measured = measure(panel, {0, 0, 0}, {0, 1, 0}, 1 << 15);
  test::record("Lambertian web of 100 cd with an opening, illuminance on its axis at 1 m, lx", "unit square", "path",
               square, measured);
  EXPECT_NEAR(measured, square, 2e-3 * square);
  // A disc of radius 0.5: pi L r² / (r² + h²), and its intensity is L pi r².
  const double disc = 100 / (0.25 + 1);
  const Scene round = blackFloor(test::webLamp({0, 1, 0}, test::lambertianWeb(100, 1, 1, true)));
  const double measuredDisc = measure(round, {0, 0, 0}, {0, 1, 0}, 1 << 15);
  test::record("Lambertian web of 100 cd with an opening, illuminance on its axis at 1 m, lx", "disc of 1 m", "path",
               disc, measuredDisc);
  EXPECT_NEAR(measuredDisc, disc, 2e-3 * disc);
  // The long side lies along C0: the corner-aligned form at a point beside a strip.
  const auto form = [](double X, double Y) {
    const double sx = std::sqrt(1 + X * X), sy = std::sqrt(1 + Y * Y);
    return (X / sx * std::atan(Y / sx) + Y / sy * std::atan(X / sy)) / (2 * 3.14159265358979);
  };
  const Scene strip = blackFloor(test::webLamp({0, 1, 0}, test::lambertianWeb(100, 2, 0.2f)));
  const double expected = 3.14159265358979 * (100 / 0.4) * 2 * form(2, 0.1);
  EXPECT_NEAR(measure(strip, {1, 0, 0}, {0, 1, 0}, 1 << 15), expected, 3e-3 * expected);
}

// All of its light arrives: walls that reflect a part of everything give as much luminance as the flux allows, with
// light paths and without. Mean illuminance in a closed room of even albedo is flux / area / (1 - albedo).
TEST(Luminaires, fluxArrivesInAClosedRoom) {
  const auto lopsided = [](float c, float g) { return 60 + 40 * std::cos(c) * std::sin(g) - 20 * g; };
  for (const bool extended : {false, true}) {
    Scene scene;
    test::addRoom(scene, {0, 0, 0}, {3, 2.5f, 4},
                  std::vector<int>(6, test::addMaterial(scene, test::lambertian(0.5f))));
    scene.lamps.push_back(
        test::webLamp({1.3f, 1.9f, 1.8f}, test::makeWeb(lopsided, 180, 5, extended ? 0.6f : 0, extended ? 0.3f : 0)));
    const RayScene rays(scene);
    const Lights lights(scene);
    const float sizes[] = {3, 2.5f, 4};
    double mean = 0, area = 0;
    for (int face = 0; face < 6; ++face) {
      const int axis = face / 2, a = (axis + 1) % 3, b = (axis + 2) % 3;
      constexpr int kGrid = 12;
      for (int i = 0; i < kGrid * kGrid; ++i) {
        Vec3 p, n;
        p[axis] = face % 2 ? sizes[axis] : 0, n[axis] = face % 2 ? -1.0f : 1.0f;
        p[a] = (static_cast<float>(i % kGrid) + 0.5f) / kGrid * sizes[a],
        p[b] = (static_cast<float>(i / kGrid) + 0.5f) / kGrid * sizes[b];
        const double part = static_cast<double>(sizes[a] * sizes[b]) / (kGrid * kGrid);
        mean += part * static_cast<double>(luminance(
                           measureIlluminance(rays, lights, p, n, 256, static_cast<uint64_t>(i)).illuminanceLux));
        area += part;
      }
    }
    const double expected = scene.lamps[0].web->fluxLm / area / 0.5;
    test::record("Closed room of albedo 0.5 lit by a lopsided web, mean illuminance, lx",
                 extended ? "0.6 x 0.3 m" : "point", "path", expected, mean / area);
    EXPECT_NEAR(mean / area, expected, 0.01 * expected);
  }
}

}  // namespace
}  // namespace roomlight
