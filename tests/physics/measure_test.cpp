// Grids, spot meters, glare ratings and daylight factors against closed forms.
#include <gtest/gtest.h>

#include <cmath>

#include "measure/glare.h"
#include "measure/measure.h"
#include "support/record.h"
#include "support/rooms.h"
#include "support/techniques.h"

namespace roomlight {
namespace {

constexpr double kPiD = 3.14159265358979323846;

class Measure : public testing::TestWithParam<std::string> {
 protected:
  std::unique_ptr<LitScene> light(const Scene& scene) {
    RenderSettings settings;
    settings.technique = GetParam();
    settings.samples = 64;
    return std::move(lightScene(scene, settings, stages_).value());
  }
  Measurements run(const Scene& scene, const MeterPlan& plan, double tolerance = 0.003) {
    MeasureSettings settings;
    settings.meters.tolerance = tolerance;
    return measure(*light(scene), plan, settings, stages_);
  }
  double allowed() const { return GetParam() == "path" ? 0.01 : 0.03; }
  void expectNear(double got, double expected, const char* what) const {
    test::record("measure", what, GetParam(), expected, got);
    EXPECT_NEAR(got, expected, allowed() * expected) << what;
  }

  const RenderProgress quiet_;
  RenderStats stats_;
  Stages stages_{quiet_, stats_};
};

// Light on a parallel element under a rectangle's corner: π L F by quadrants (the configuration factor of a parallel
// rectangle).
double quadrant(double a, double b, double c) {
  const double x = a / c, y = b / c, u = std::sqrt(1 + x * x), v = std::sqrt(1 + y * y);
  return (x / u * std::atan(y / u) + y / v * std::atan(x / v)) / 2;
}

// A lamp of 1 m² in a ceiling 2 m above a black floor of 4 x 4 m.
TEST_P(Measure, gridUnderAnAreaLamp) {
  Scene scene;
  test::addRoom(scene, {0, 0, 0}, {4, 3, 4}, std::vector<int>(6, test::addMaterial(scene, test::lambertian(0))));
  test::addRectangle(scene, {1.5f, 2.999f, 1.5f}, {1, 0, 0}, {0, 0, 1},
                     test::addMaterial(scene, test::lambertian(0, 1000)));
  RoomPlan room;
  room.room.floor = {{0, 0}, {0, 4}, {4, 4}, {4, 0}};
  room.workPlaneM = 1;
  MeterPlan plan;
  plan.rooms = {room};
  const Measurements m = run(scene, plan);
  ASSERT_EQ(m.grids.size(), 1u);
  double sum = 0, least = 1e9, most = 0;
  const std::vector<SurfaceElement> elements = m.grids[0].points.lattice.elements();
  for (const SurfaceElement& e : elements) {
    double lux = 0;
    for (const int k : {0, 1, 2, 3}) {  // corners of the lamp, with sign
      const double a = (k & 1 ? 2.5 : 1.5) - static_cast<double>(e.position.x),
                   b = (k & 2 ? 2.5 : 1.5) - static_cast<double>(e.position.z);
      const double sign = ((k & 1) != 0) == ((k & 2) != 0) ? 1 : -1;
      lux += sign * (a < 0 ? -1 : 1) * (b < 0 ? -1 : 1) * 1000 * quadrant(std::abs(a), std::abs(b), 1.999);
    }
    sum += lux, least = std::min(least, lux), most = std::max(most, lux);
  }
  const Statistics s = m.grids[0].lux();
  EXPECT_EQ(s.points, 49u);
  expectNear(s.mean, sum / 49, "grid under an area lamp, mean lx");
  expectNear(s.least, least, "grid under an area lamp, min lx");
  expectNear(s.most, most, "grid under an area lamp, max lx");
}

// L = ρ E / π on a wall that a lamp 2 m before it lights alone.
TEST_P(Measure, spotMeterOnALambertianWall) {
  Scene scene;
  test::addRectangle(scene, {-2, -2, 0}, {4, 0, 0}, {0, 4, 0}, test::addMaterial(scene, test::lambertian(0.5f)));
  scene.lamps.push_back(test::pointLamp({0, 0, 2}, 400));
  MeterPlan plan;
  plan.spots = {{"wall", {0.5f, 0.5f, 3}, normalize(Vec3{-0.5f, -0.5f, -3}), 1}};
  const Measurements m = run(scene, plan);
  ASSERT_EQ(m.spots.size(), 1u);
  expectNear(m.spots[0].luminanceCdM2, 0.5 * 100 / kPiD, "spot meter on a wall, cd/m²");
}

// A square lamp on the line of sight in a furnace: the background is the furnace's luminance where the lamp does not
// hide it.
TEST_P(Measure, glareOfASquareBeforeAnEvenBackground) {
  Scene scene;
  scene.sky.luminanceCdM2 = Vec3(50);
  test::addRectangle(scene, {-0.25f, -0.25f, -2}, {0.5f, 0, 0}, {0, 0.5f, 0},
                     test::addMaterial(scene, test::lambertian(0, 4000)));
  MeterPlan plan;
  plan.glares = {{"eye", {0, 0, 0}, {0, 0, -1}, {}}};
  const Measurements m = run(scene, plan, 0.01);
  ASSERT_TRUE(m.glares[0].ugr.has_value());
  const double omega = 4 * std::asin(0.0625 / 4.0625), form = 4 * quadrant(0.25, 0.25, 2) / kPiD;
  const double background = 50 * (1 - form), expected = 8 * std::log10(0.25 / background * 4000.0 * 4000 * omega);
  expectNear(m.glares[0].backgroundCdM2, background, "background of a square lamp, cd/m²");
  test::record("measure", "UGR of a square lamp", GetParam(), expected, *m.glares[0].ugr);
  EXPECT_NEAR(*m.glares[0].ugr, expected, 0.1);
  EXPECT_LT(m.glares[0].ugrError, 0.1);
}

TEST_P(Measure, daylightFactorIsAHundredInTheOpenAndLessOnAWall) {
  Scene scene;
  test::addRectangle(scene, {0, -50, 0}, {0, 0, 1}, {1, 0, 0}, test::addMaterial(scene, test::lambertian(0, 1000)));
  lightByOvercastSky(scene, 0);
  MeterPlan plan;
  plan.points = {{"open", {{0, 0, 0}, {0, 1, 0}}, {}}, {"wall", {{0, 0, 0}, {1, 0, 0}}, {}}};
  const std::unique_ptr<LitScene> lit = light(scene);
  MeasureSettings settings;
  settings.meters.tolerance = 0.003;
  Measurements m = measure(*lit, plan, settings, stages_);
  addDaylight(m, *lit, settings.meters, stages_);
  expectNear(*m.points[0].daylightPercent, 100, "daylight factor in the open, %");
  // On a vertical plane: L_z/3 (π/2 + 4/3), of 7π/9 L_z.
  expectNear(*m.points[1].daylightPercent, 100 * (kPiD / 2 + 4.0 / 3) / 3 / (7 * kPiD / 9),
             "daylight factor on a wall in the open, %");
}

INSTANTIATE_TEST_SUITE_P(Techniques, Measure, testing::ValuesIn(test::preciseTechniques()),
                         [](const auto& p) { return p.param; });

}  // namespace
}  // namespace roomlight
