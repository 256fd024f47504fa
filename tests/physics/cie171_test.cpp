// Set-ups after CIE 171:2006 whose expected values follow from closed forms. z is up in the standard; here y is up, and
// the standard's (x, y, z) is (x, z, y). Tolerance: 1 % of each point.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"
#include "reference/path_tracer.h"
#include "support/record.h"
#include "support/rooms.h"

namespace roomlight {
namespace {

Vec3 cie(float x, float y, float z) { return {x, z, y}; }

double measure(const Scene& scene, Vec3 p, Vec3 n, int samples = 1 << 14) {
  const RayScene rays(scene);
  const Lights lights(scene);
  return luminance(measureIlluminance(rays, lights, p, n, samples, 3).illuminanceLux);
}

void expectWithinOnePercent(double value, double expected, const std::string& group, const std::string& what) {
  test::record("CIE 171, " + group, what, "path", expected, value);
  EXPECT_NEAR(value, expected, 0.01 * std::abs(expected) + 1e-9) << group << ": " << what;
}

std::string wallPoint(int i) { return fmt::format("wall {}, z = {} m", "ABCDEF"[i], 2.75 - 0.5 * i); }
std::string floorPoint(int i) { return fmt::format("floor {}, y = {} m", "GHJKLMN"[i], 0.25 + 0.5 * i); }

Scene blackRoom() {
  Scene scene;
  const int black = test::addMaterial(scene, test::lambertian(0));
  test::addRoom(scene, {0, 0, 0}, {4, 3, 4}, std::vector<int>(6, black));
  return scene;
}

TEST(Cie171, Test52PointSourceAbove) {
  // A Lambertian point: a spot whose falloff is not the cosine cannot stand for it, so a tiny emitter does.
  Scene scene = blackRoom();
  const float side = 0.01f;
  test::addRectangle(scene, {2 - side / 2, 2.9999f, 2 - side / 2}, {side, 0, 0}, {0, 0, side},
                     test::addMaterial(scene, test::lambertian(0, 1000 / (side * side))));
  const float h = 2.9999f;
  const float points[][2] = {{0, 0}, {.5f, 0}, {1, 0}, {1.5f, 0}, {1, 1}, {1.5f, 1.5f}};
  const auto at = [](const float* p) { return fmt::format("{} m, {} m from below it", p[0], p[1]); };
  for (const auto& p : points) {
    const double d2 = p[0] * p[0] + p[1] * p[1] + h * h;
    expectWithinOnePercent(measure(scene, {2 + p[0], 0, 2 + p[1]}, {0, 1, 0}), 1000.0 * h * h / (d2 * d2), "5.2, Lambertian point of 1000 cd, lx", at(p));
  }
  // An isotropic point: E = I h / d³.
  Scene isotropic = blackRoom();
  isotropic.lamps.push_back(test::pointLamp({2, 2.5f, 2}, 100));
  for (const auto& p : points) {
    const double d2 = p[0] * p[0] + p[1] * p[1] + 2.5 * 2.5;
    expectWithinOnePercent(measure(isotropic, {2 + p[0], 0, 2 + p[1]}, {0, 1, 0}, 16), 100 * 2.5 / std::pow(d2, 1.5), "5.2, isotropic point of 100 cd, lx", at(p));
  }
}

TEST(Cie171, Test53AreaSourceAtTheCeiling) {
  Scene scene = blackRoom();
  test::addRectangle(scene, {1.5f, 2.9999f, 1.5f}, {1, 0, 0}, {0, 0, 1}, test::addMaterial(scene, test::lambertian(0, 1000)));
  const double wall[] = {32.68, 75.09, 81.38, 69.12, 53.41, 39.90};
  for (int i = 0; i < 6; ++i) {
    expectWithinOnePercent(measure(scene, cie(2, 0, 2.75f - 0.5f * static_cast<float>(i)), cie(0, 1, 0)), wall[i], "5.3, area source at the ceiling, lx", wallPoint(i));
  }
  const double floor[] = {61.27, 79.18, 95.52, 105.89};
  for (int i = 0; i < 4; ++i) {
    expectWithinOnePercent(measure(scene, cie(2, 0.25f + 0.5f * static_cast<float>(i), 0), cie(0, 0, 1)), floor[i], "5.3, area source at the ceiling, lx", floorPoint(i));
  }
}

TEST(Cie171, Test54LuminousFluxIsConserved) {
  Scene scene = blackRoom();
  const float flux = 10000;
  scene.lamps.push_back(test::pointLamp({1.3f, 1.9f, 2.4f}, flux / (4 * kPi)));
  const RayScene rays(scene);
  const Lights lights(scene);
  const int n = 64;
  double sum = 0;
  const Vec3 size{4, 3, 4};
  for (int axis = 0; axis < 3; ++axis) {
    const int ua = (axis + 1) % 3, va = (axis + 2) % 3;
    for (int side = 0; side < 2; ++side) {
      for (int k = 0; k < n * n; ++k) {
        Vec3 p, normal;
        p[ua] = size[ua] * (static_cast<float>(k % n) + 0.5f) / n;
        p[va] = size[va] * (static_cast<float>(k / n) + 0.5f) / n;
        p[axis] = side ? size[axis] : 0;
        normal[axis] = side ? -1.0f : 1.0f;
        sum += luminance(measureIlluminance(rays, lights, p, normal, 1, 0).illuminanceLux) * size[ua] * size[va] / (n * n);
      }
    }
  }
  expectWithinOnePercent(sum / flux, 1, "5.4, conservation of flux", "sum of E A / flux");
}

TEST(Cie171, Test56DiffuseReflectionOfTheGround) {
  // Ground 4x4 of albedo 0.3 under a uniform illuminance; black wall at y = 4 above it and a black ceiling.
  Scene scene;
  const int black = test::addMaterial(scene, test::lambertian(0));
  const float ehz = 1000, rho = 0.3f;
  test::addRectangle(scene, cie(0, 0, 0), {0, 0, 4}, {4, 0, 0}, test::addMaterial(scene, test::lambertian(0, ehz * rho / kPi)));
  test::addRectangle(scene, cie(0, 4, 0.5f), {0, 2.5f, 0}, {4, 0, 0}, black);
  test::addRectangle(scene, cie(0, 0, 3), {4, 0, 0}, {0, 0, 4}, black);
  const double wall[] = {35.90, 27.99, 21.64, 16.72, 12.97};
  for (int i = 0; i < 5; ++i) {
    const double e = measure(scene, cie(2, 4, 0.75f + 0.5f * static_cast<float>(i)), cie(0, -1, 0));
    expectWithinOnePercent(100 * e / (ehz * rho), wall[i], "5.6, light from the ground, %", fmt::format("wall, z = {} m", 0.75 + 0.5 * i));
  }
  const double ceiling[] = {26.80, 30.94, 33.98, 35.57};
  for (int i = 0; i < 4; ++i) {
    const double e = measure(scene, cie(2, 0.25f + 0.5f * static_cast<float>(i), 3), cie(0, 0, -1));
    expectWithinOnePercent(100 * e / (ehz * rho), ceiling[i], "5.6, light from the ground, %", fmt::format("ceiling, y = {} m", 0.25 + 0.5 * i));
  }
}

TEST(Cie171, Test57DiffuseReflectionWithInternalObstruction) {
  // Reflecting wall at y = 4 (4 wide, 3 high, albedo 0.6) under a uniform vertical illuminance, everything else black, a
  // black box across the room from y = 2.5 to 2.7, 1 m high. A-F lie on the opposite wall, G-N on the floor.
  Scene scene;
  const int black = test::addMaterial(scene, test::lambertian(0));
  const float ev = 1000, rho = 0.6f;
  test::addRectangle(scene, cie(0, 4, 0), {0, 3, 0}, {4, 0, 0}, test::addMaterial(scene, test::lambertian(0, ev * rho / kPi)));
  test::addBox(scene, {0, 0, 2.5f}, {4, 1, 2.7f}, black);
  const double wall[] = {16.08, 16.33, 15.40, 13.33, 10.32, 7.08};
  for (int i = 0; i < 6; ++i) {
    const double e = measure(scene, cie(2, 0, 2.75f - 0.5f * static_cast<float>(i)), cie(0, 1, 0), 1 << 16);
    expectWithinOnePercent(100 * e / (ev * rho), wall[i], "5.7, internal obstruction, %", wallPoint(i));
  }
  const double floor[] = {3.38, 3.63, 3.02, 0, 0};
  for (int i = 0; i < 5; ++i) {
    const double e = measure(scene, cie(2, 0.25f + 0.5f * static_cast<float>(i), 0), cie(0, 0, 1), 1 << 17);
    test::record("CIE 171, 5.7, internal obstruction, %", floorPoint(i), "path", floor[i], 100 * e / (ev * rho));
    EXPECT_NEAR(100 * e / (ev * rho), floor[i], std::max(0.01 * floor[i], 0.005)) << "floor " << i;
  }
}

class Test58 : public testing::TestWithParam<std::pair<float, float>> {};

TEST_P(Test58, InternalReflectionsOfTheDiffuseSphereApproximation) {
  const auto [rho, expected] = GetParam();
  Scene scene;
  const int wall = test::addMaterial(scene, test::lambertian(rho));
  test::addRoom(scene, {0, 0, 0}, {4, 4, 4}, std::vector<int>(6, wall));
  scene.lamps.push_back(test::pointLamp({2, 2, 2}, 10000 / (4 * kPi)));
  const RayScene rays(scene);
  const Lights lights(scene);
  // By symmetry one wall stands for all six. Direct light at its points is known exactly and taken off.
  const int n = 32;
  double indirect = 0;
  for (int k = 0; k < n * n; ++k) {
    const float u = 4 * (static_cast<float>(k % n) + 0.5f) / n, v = 4 * (static_cast<float>(k / n) + 0.5f) / n;
    const double total = luminance(measureIlluminance(rays, lights, {u, 0, v}, {0, 1, 0}, 64, static_cast<uint64_t>(k)).illuminanceLux);
    const double d2 = 4 + (u - 2.0) * (u - 2.0) + (v - 2.0) * (v - 2.0);
    indirect += (total - 10000 / (4 * 3.14159265358979) * 2 / std::pow(d2, 1.5)) / (n * n);
  }
  expectWithinOnePercent(indirect, expected, "5.8, mean indirect illuminance in a cube, lx", fmt::format("albedo {}", rho));
}
INSTANTIATE_TEST_SUITE_P(Albedos, Test58,
                         testing::Values(std::pair{.05f, 5.482f}, std::pair{.2f, 26.04f}, std::pair{.5f, 104.17f},
                                         std::pair{.8f, 416.7f}, std::pair{.9f, 937.5f}, std::pair{.95f, 1979.f}));

}  // namespace
}  // namespace roomlight
