// Bulbs as emissive meshes, whose light paths start in them, held against closed forms and against lamps.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "reference/path_tracer.h"
#include "support/record.h"
#include "support/rooms.h"

namespace roomlight {
namespace {

std::vector<MeterReading> readings(const Scene& scene, const std::vector<SurfaceElement>& elements, double tolerance,
                                   int mostSamples) {
  const RayScene rays(scene);
  const Lights lights(scene);
  MeterSettings settings;
  settings.tolerance = tolerance, settings.mostSamples = mostSamples;
  return measureIlluminance(rays, lights, elements, settings);
}

// A black bulb of flux F and area a in the middle of a sphere of area A and albedo rho. All light E A that arrives on
// the wall is F and what the wall sends back but for the part a / A that ends on the bulb (reciprocity: the bulb sees
// wall only): E = F / (A (1 - rho (1 - a / A))).
class IntegratingSphere : public testing::TestWithParam<float> {};

TEST_P(IntegratingSphere, illuminanceIsTheClosedForm) {
  const float rho = GetParam();
  constexpr double kRadiusM = 1, kBulbM = 0.05, kLuminance = 3000, kPiD = std::numbers::pi;
  constexpr int kParts = 96;
  Scene scene;
  test::addSphere(scene, {0, 0, 0}, static_cast<float>(kRadiusM), test::addMaterial(scene, test::lambertian(rho)),
                  kParts);
  test::addSphere(scene, {0, 0, 0}, static_cast<float>(kBulbM),
                  test::addMaterial(scene, test::lambertian(0, static_cast<float>(kLuminance))), kParts);
  const double wall = 4 * kPiD * kRadiusM * kRadiusM, bulb = 4 * kPiD * kBulbM * kBulbM,
               lumens = kPiD * bulb * kLuminance;
  const double expected = lumens / wall / (1 - static_cast<double>(rho) * (1 - bulb / wall));
  // In the middles of faces, which lie a little inside the sphere.
  std::vector<SurfaceElement> elements;
  for (const double polar : {0.5, 1.1, 1.9}) {
    const double t = (std::floor(polar / kPiD * kParts) + 0.5) / kParts * kPiD, turn = kPiD / (2 * kParts);
    const Vec3 out{static_cast<float>(std::sin(t) * std::cos(turn)), static_cast<float>(-std::cos(t)),
                   static_cast<float>(std::sin(t) * std::sin(turn))};
    elements.push_back({out * 0.999f, -out});
  }
  // Light paths are the same for all meters: many, so that their number of reflections evens out to less than the
// tolerance.
  for (const MeterReading& r : readings(scene, elements, 0.001, 1 << 17)) {
    const double measured = static_cast<double>(luminance(r.illuminanceLux));
    test::record("Sphere of 1 m radius with a bulb of 5 cm, illuminance, lx", fmt::format("albedo {}", rho), "path",
                 expected, measured);
    EXPECT_NEAR(measured, expected, 0.01 * expected);
    EXPECT_LT(3 * r.standardErrorLux, 0.01 * expected) << "else the test cannot tell";
  }
}
INSTANTIATE_TEST_SUITE_P(Albedos, IntegratingSphere, testing::Values(0.3f, 0.9f));

// Where none of the bulb is seen, so that all light comes from the shade's inside, ceiling and table.
TEST(TableLamp, metersReadOfABulbWhatTheyReadOfAPoint) {
  const std::vector<SurfaceElement> elements{{{1.3f, 0.74f, 0.9f}, {0, 1, 0}},
                                             {{3, 0.8f, 2}, {0, 1, 0}},
                                             {{2, 1.2f, 3.5f}, {0, 0, -1}},
                                             {{0, 1.1f, 0.7f}, {1, 0, 0}}};
  const std::vector<MeterReading> point = readings(test::tableLamp(false), elements, 0.01, 1 << 16),
                                  bulb = readings(test::tableLamp(true), elements, 0.01, 1 << 16);
  for (size_t i = 0; i < elements.size(); ++i) {
    const double expected = static_cast<double>(luminance(point[i].illuminanceLux)),
                 measured = static_cast<double>(luminance(bulb[i].illuminanceLux));
    EXPECT_LT(bulb[i].standardErrorLux, 0.01 * measured) << i;
    EXPECT_NEAR(measured, expected,
                0.01 * expected + 3 * std::hypot(point[i].standardErrorLux, bulb[i].standardErrorLux))
        << i;
  }
}

}  // namespace
}  // namespace roomlight
