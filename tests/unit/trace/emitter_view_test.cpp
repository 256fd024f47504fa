// A ball seen from a small place.
#include "trace/emitter_view.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/rooms.h"

namespace roomlight {
namespace {

constexpr double kRadiusM = 0.15, kEmission = 1000;

Scene withBall(bool doubleSided) {
  constexpr int kRings = 16, kSectors = 30;
  Scene scene;
  Material shining = test::lambertian(0, static_cast<float>(kEmission));
  shining.doubleSided = doubleSided;
  const auto at = [](int i, int k) {
    const double polar = std::numbers::pi * i / kRings, turn = 2 * std::numbers::pi * k / kSectors;
    return Vec3{static_cast<float>(std::sin(polar) * std::cos(turn)), static_cast<float>(std::cos(polar)),
                static_cast<float>(-std::sin(polar) * std::sin(turn))} *
           static_cast<float>(kRadiusM);
  };
  Mesh mesh;
  mesh.material = test::addMaterial(scene, shining);
  for (int i = 0; i < kRings; ++i) {
    for (int k = 0; k < kSectors; ++k) {
      for (const Vec3 p : {at(i, k), at(i + 1, k), at(i, k + 1), at(i, k + 1), at(i + 1, k), at(i + 1, k + 1)}) {
        mesh.indices.push_back(static_cast<uint32_t>(mesh.positions.size()));
        mesh.positions.push_back(p);
      }
    }
  }
  scene.instances.push_back({"ball", static_cast<int>(scene.meshes.size()), -1, {}});
  scene.meshes.push_back(std::move(mesh));
  return scene;
}

struct Moments {
  double mean = 0, deviation = 0;
};

// lx on a surface that faces the middle of the ball, without shadows.
template <class Sample>
Moments illuminance(Vec3 p, const Sample& sample) {
  constexpr uint32_t kSamples = 40000;
  const Vec3 n = normalize(-p);
  double sum = 0, squares = 0;
  for (uint32_t i = 0; i < kSamples; ++i) {
    Sampler sampler(1, i, 0);
    const Vec2 u = sampler.next2();
    const LightSample light = sample(p, u, sampler.next1());
    const double lux =
        light.valid() ? static_cast<double>(luminance(light.radiance) * std::max(0.0f, dot(light.wi, n))) : 0;
    sum += lux, squares += lux * lux;
  }
  const double mean = sum / kSamples;
  return {mean, std::sqrt(std::max(0.0, squares / kSamples - mean * mean))};
}

// Of a ball of even luminance L, seen from d: pi L (r / d)^2, for a front that shines outwards only.
TEST(EmitterView, givesTheLightOfTheWholeMesh) {
  const Scene scene = withBall(false);
  const Lights lights(scene);
  const Bounds3 place{{0.6f, 0.3f, -0.2f}, {1.2f, 0.9f, 0.4f}};
  const EmitterView view(lights, 0, place);
  ASSERT_FALSE(view.dark());
  for (const Vec3 p : {place.lo, place.centre(), place.hi}) {
    const double d2 = static_cast<double>(lengthSquared(p)),
                 expected = std::numbers::pi * kEmission * kRadiusM * kRadiusM / d2;
    const Moments seen = illuminance(p, [&](Vec3 q, Vec2 u, float choice) { return view.sample(q, u, choice); });
    const Moments whole =
        illuminance(p, [&](Vec3 q, Vec2 u, float choice) { return lights.sampleEmitter(0, q, u, choice); });
    EXPECT_NEAR(seen.mean, whole.mean, 0.02 * whole.mean);
    EXPECT_NEAR(seen.mean, expected, 0.02 * expected);  // the ball has corners
    EXPECT_LT(seen.deviation, 0.75 * seen.mean);
    EXPECT_LT(seen.deviation, whole.deviation);
  }
}

TEST(EmitterView, ofASheetIsDarkBehindIt) {
  for (const bool doubleSided : {false, true}) {
    Scene scene;
    Material shining = test::lambertian(0, 100);
    shining.doubleSided = doubleSided;
    test::addRectangle(scene, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, test::addMaterial(scene, shining), 3);
    const Lights lights(scene);
    EXPECT_FALSE(EmitterView(lights, 0, {{0, 0, 0.1f}, {1, 1, 0.9f}}).dark());
    EXPECT_EQ(EmitterView(lights, 0, {{0, 0, -0.9f}, {1, 1, -0.1f}}).dark(), !doubleSided);
  }
}

}  // namespace
}  // namespace roomlight
