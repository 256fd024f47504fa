// Light meters of every technique against closed forms: 1 % for path and 3 % for hybrid at each point, 10 % in total for cone.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "base/parallel.h"
#include "engine/lit_scene.h"
#include "support/record.h"
#include "support/rooms.h"

namespace roomlight {
namespace {

class Meters : public testing::TestWithParam<const char*> {
 protected:
  std::vector<double> read(const Scene& scene, const std::vector<SurfaceElement>& elements, double tolerance = 0.002) const {
    RenderSettings settings;
    settings.technique = GetParam();
    RenderStats stats;
    const RenderProgress quiet;
    Stages stages(quiet, stats);
    MeterSettings meter;
    meter.tolerance = tolerance;
    std::vector<double> lux;
    for (const MeterReading& r : lightScene(scene, settings, stages).value()->illuminance(elements, meter)) lux.push_back(static_cast<double>(luminance(r.illuminanceLux)));
    return lux;
  }
  void expectNear(const std::vector<double>& got, const std::vector<double>& expected, const std::string& group) const {
    const std::string technique = GetParam();
    const double allowed = technique == "path" ? 0.01 : 0.03;
    for (size_t i = 0; i < got.size(); ++i) {
      test::record(group, fmt::format("point {}", i), technique, expected[i], got[i]);
      if (technique == "cone") continue;
      EXPECT_NEAR(got[i], expected[i], allowed * expected[i]) << group << ", point " << i;
    }
    const double sum = std::accumulate(got.begin(), got.end(), 0.0), all = std::accumulate(expected.begin(), expected.end(), 0.0);
    EXPECT_NEAR(sum, all, (technique == "cone" ? 0.1 : allowed) * all) << group;
  }
};

// CIE 171:2006, 5.3.
TEST_P(Meters, seeAnAreaLamp) {
  Scene scene;
  test::addRoom(scene, {0, 0, 0}, {4, 3, 4}, std::vector<int>(6, test::addMaterial(scene, test::lambertian(0))));
  test::addRectangle(scene, {1.5f, 2.9999f, 1.5f}, {1, 0, 0}, {0, 0, 1}, test::addMaterial(scene, test::lambertian(0, 1000)));
  std::vector<SurfaceElement> elements;
  for (int i = 0; i < 6; ++i) elements.push_back({{2, 2.75f - 0.5f * static_cast<float>(i), 0}, {0, 0, 1}});
  for (int i = 0; i < 4; ++i) elements.push_back({{2, 0, 0.25f + 0.5f * static_cast<float>(i)}, {0, 1, 0}});
  expectNear(read(scene, elements), {32.68, 75.09, 81.38, 69.12, 53.41, 39.90, 61.27, 79.18, 95.52, 105.89}, "meters, area source at the ceiling, lx");
}

// CIE 171:2006, 5.6, with a real sun and a real ground for what they send out.
TEST_P(Meters, seeSunlightThatTheGroundReflects) {
  Scene scene;
  test::addRectangle(scene, {0, 0, 0}, {0, 0, 4}, {4, 0, 0}, test::addMaterial(scene, test::lambertian(0.3f)));
  test::addRectangle(scene, {0, 0.5f, 4}, {0, 2.5f, 0}, {4, 0, 0}, test::addMaterial(scene, test::lambertian(0)));
  scene.suns.push_back({"", {0, 1, 0}, Vec3(1000), 0});
  std::vector<SurfaceElement> elements;
  for (int i = 0; i < 5; ++i) elements.push_back({{2, 0.75f + 0.5f * static_cast<float>(i), 4}, {0, 0, -1}});
  expectNear(read(scene, elements), {107.70, 83.97, 64.92, 50.16, 38.91}, "meters, light from the ground, lx");
}

// CIE 171:2006, 5.8: the mean over a wall, where direct light is known.
TEST_P(Meters, seeManyBounces) {
  for (const double albedo : {0.2, 0.5, 0.8}) {
    Scene scene;
    test::addRoom(scene, {0, 0, 0}, {4, 4, 4}, std::vector<int>(6, test::addMaterial(scene, test::lambertian(static_cast<float>(albedo)))));
    scene.lamps.push_back(test::pointLamp({2, 2, 2}, 10000 / (4 * kPi)));
    std::vector<SurfaceElement> elements;
    constexpr int n = 16;
    double direct = 0;
    for (int k = 0; k < n * n; ++k) {
      const float u = 4 * (static_cast<float>(k % n) + 0.5f) / n, v = 4 * (static_cast<float>(k / n) + 0.5f) / n;
      elements.push_back({{u, 0, v}, {0, 1, 0}});
      direct += 10000 / (4 * 3.14159265358979) * 2 / std::pow(4 + (u - 2.0) * (u - 2.0) + (v - 2.0) * (v - 2.0), 1.5) / (n * n);
    }
    const std::vector<double> lux = read(scene, elements, 0.02);
    expectNear({std::accumulate(lux.begin(), lux.end(), 0.0) / (n * n) - direct}, {10000 * albedo / (96 * (1 - albedo))}, fmt::format("meters, cube of albedo {}, mean indirect lx", albedo));
  }
}

// In the middle of the air there are no voxels.
TEST_P(Meters, hangInTheAir) {
  Scene scene;
  test::addRoom(scene, {0, 0, 0}, {4, 3, 4}, std::vector<int>(6, test::addMaterial(scene, test::lambertian(0.5f, 100))));
  expectNear(read(scene, {{{2, 1.5f, 2}, {0, 1, 0}}, {{1, 0.85f, 3}, {0, 0.6f, 0.8f}}}), {200 * 3.14159265, 200 * 3.14159265}, "meters, furnace, lx");
}

TEST_P(Meters, doNotDependOnThreads) {
  Scene scene;
  test::addRoom(scene, {0, 0, 0}, {4, 3, 4}, std::vector<int>(6, test::addMaterial(scene, test::lambertian(0.5f))));
  scene.lamps.push_back(test::pointLamp({1, 2, 2}, 100));
  std::vector<double> lux[2];
  for (const int threads : {1, 2}) withThreads(threads, [&] { lux[threads - 1] = read(scene, {{{2, 0, 2}, {0, 1, 0}}, {{1, 1.5f, 3}, {0, 0.6f, 0.8f}}}); });
  EXPECT_EQ(lux[0], lux[1]);
}

INSTANTIATE_TEST_SUITE_P(Techniques, Meters, testing::Values("path", "hybrid", "cone"), [](const auto& p) { return std::string(p.param); });

}  // namespace
}  // namespace roomlight
