// Technique lpv where the light is known: how far its theory lets it be off, and that it is not off by more.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "base/parallel.h"
#include "baselines/lpv.h"
#include "support/record.h"
#include "support/rooms.h"

namespace roomlight {
namespace {

LpvSettings small() {
  LpvSettings s;
  s.width = s.height = 24;
  s.samples = 16;
  s.filterPasses = 0;
  s.mapSize = 128;
  return s;
}

// Until nothing is left on its way.
LpvSettings settled() {
  LpvSettings s = small();
  s.cells = 16, s.steps = 200;
  return s;
}

GatheredPicture render(const Scene& scene, Vec3 eye, const LpvSettings& settings) {
  const RayScene rays(scene);
  const Lights lights(scene, true);
  const LpvLight light = lightLpv(rays, lights, rays.bounds(), settings);
  return gatherPicture(rays, lights, LpvShader(rays, lights, light, settings), test::cameraAt(eye), settings, {});
}

// Mean indirect illuminance on the floor of a cube of 4 m with a lamp of 1000 lm in the middle, and its truth rho / (1
// - rho) 1000 / 96.
double floorLux(float rho, const LpvSettings& settings) {
  Scene scene;
  test::addRoom(scene, {0, 0, 0}, {4, 4, 4}, std::vector<int>(6, test::addMaterial(scene, test::lambertian(rho))));
  scene.lamps.push_back(test::pointLamp({2, 2, 2}, 1000 / (4 * kPi)));
  const RayScene rays(scene);
  const Lights lights(scene, true);
  const LpvLight light = lightLpv(rays, lights, rays.bounds(), settings);
  double sum = 0;
  constexpr int kPlaces = 12;
  for (int i = 0; i < kPlaces * kPlaces; ++i) {
    const Vec3 p{4 * (static_cast<float>(i % kPlaces) + 0.5f) / kPlaces, 0,
                 4 * (static_cast<float>(i / kPlaces) + 0.5f) / kPlaces};
    sum += static_cast<double>(lpvIrradiance(light, p, {0, 1, 0}, {0, 1, 0}, settings).x * kPi) / (kPlaces * kPlaces);
  }
  return sum;
}

// Of the light that one reflection sends about a room: never more than there is, and as much as a grid without gains
// keeps. A wall lets a quarter of what meets it straight through, and surfaces stop some of the light that goes along
// them; with few steps, light is still on its way.
TEST(Lpv, oneReflectionIsFoundButForWhatWallsLetThrough) {
  const float rho = 0.5f;
  const double truth = static_cast<double>(rho) * 1000 / 96;
  LpvSettings s = settled();
  s.bounces = false;
  const double all = floorLux(rho, s) / truth;
  s.steps = 16;
  const double few = floorLux(rho, s) / truth;
  test::record("Cube of 4 m, lamp of 1000 lm, illuminance once reflected, of the truth", "16 cells, 200 steps", "lpv",
               1, all);
  test::record("Cube of 4 m, lamp of 1000 lm, illuminance once reflected, of the truth", "16 cells, 16 steps", "lpv", 1,
               few);
  EXPECT_GT(all, 0.55);
  EXPECT_LT(all, 1);
  EXPECT_GT(few, 0.35);
  EXPECT_LT(few, all);
}

// What walls send back adds to it, and never to more than the truth.
TEST(Lpv, bouncesAddLightButNeverTooMuch) {
  const float rho = 0.8f;
  LpvSettings s = settled();
  const double with = floorLux(rho, s), truth = static_cast<double>(rho / (1 - rho)) * 1000 / 96;
  s.bounces = false;
  const double without = floorLux(rho, s);
  test::record("Cube of 4 m, lamp of 1000 lm, indirect illuminance", "albedo 0.8, 200 steps", "lpv", truth, with);
  EXPECT_GT(with, 1.3 * without);
  EXPECT_LT(with, truth);
}

class LpvFurnace : public testing::TestWithParam<float> {};

// Every wall emits 10 and reflects a share rho: L = 10 / (1 - rho). Emitted light comes by shadow rays in full: so at
// least half of what lies between 10 (1 + rho) and all is there, never more than there is.
TEST_P(LpvFurnace, findsMoreThanHalfOfTheIndirectLight) {
  const float rho = GetParam();
  Scene scene;
  test::addRoom(scene, {0, 0, 0}, {4, 2.6f, 3},
                std::vector<int>(6, test::addMaterial(scene, test::lambertian(rho, 10))));
  const double measured = test::meanLuminance(render(scene, {1.7f, 1.4f, 2.6f}, settled()).image),
               direct = 10 * (1 + static_cast<double>(rho)), all = 10 / (1 - static_cast<double>(rho));
  test::record("Furnace, walls of 10 cd/m² each, luminance", fmt::format("albedo {}", rho), "lpv", all, measured);
  EXPECT_GT(measured, rho > 0 ? direct + 0.55 * (all - direct) : 0.995 * all);
  EXPECT_LT(measured, 1.005 * all);
}
INSTANTIATE_TEST_SUITE_P(Albedos, LpvFurnace, testing::Values(0.0f, 0.2f, 0.5f, 0.8f));

TEST(Lpv, sameBitsWithAnyNumberOfThreads) {
  Scene scene;
  test::addRoom(scene, {0, 0, 0}, {4, 2.6f, 3}, std::vector<int>(6, test::addMaterial(scene, test::lambertian(0.5f))));
  scene.lamps.push_back(test::pointLamp({1, 2, 1}, 100));
  LpvSettings s = small();
  s.filterPasses = 3;
  std::vector<Image> images;
  for (const int threads : {1, 2}) {
    withThreads(threads, [&] { images.push_back(render(scene, {1.7f, 1.4f, 2.6f}, s).image); });
  }
  for (size_t i = 0; i < images[0].pixels.size(); ++i) {
    for (int k = 0; k < 3; ++k) ASSERT_EQ(images[0].pixels[i][k], images[1].pixels[i][k]) << "pixel " << i;
  }
}

}  // namespace
}  // namespace roomlight
