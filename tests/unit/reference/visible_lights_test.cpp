// Lights chosen by what is visible of them: against all of them.
#include "reference/visible_lights.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>

#include "base/parallel.h"
#include "reference/path_tracer.h"
#include "reference/path_walk.h"
#include "support/light_densities.h"
#include "support/rooms.h"

namespace roomlight {
namespace {

constexpr uint32_t kSamples = 40'000;
constexpr int kWidth = 24, kHeight = 16;

// Two rooms with a wall between, a lamp and two shining balls in each; the camera stands in one.
struct TwoRooms {
  Scene scene;
  Camera camera;
  explicit TwoRooms(int lamps = 1) {
    const int grey = test::addMaterial(scene, test::lambertian(0.5f)),
              shining = test::addMaterial(scene, test::lambertian(0, 2000));
    for (const float x : {0.0f, 3.2f}) {
      test::addRoom(scene, {x, 0, 0}, {3, 2.5f, 4}, std::vector<int>(6, grey));
      for (int i = 0; i < lamps; ++i)
        scene.lamps.push_back(
            test::pointLamp({x + 1, 2.1f, 2 + 0.02f * static_cast<float>(i)}, 100 / static_cast<float>(lamps)));
      for (const float z : {1.0f, 3.0f}) test::addSphere(scene, {x + 2, 2.1f, z}, 0.05f, shining, 8);
    }
    camera.worldFromCamera = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1.5f, 1.4f, 3.9f}};
    camera.yFovRad = 1.2f;
  }
};

struct Known {
  RayScene rays;
  Lights lights;
  VisibleLights visible;
  explicit Known(const TwoRooms& rooms) : rays(rooms.scene), lights(rooms.scene), visible(lights) {
    visible.learn(rays, {CameraRays(rooms.camera, kWidth, kHeight), kWidth, kHeight}, 4000, 1);
  }
};

// On the floor beside the wall, where lights of the other room are as near.
const Vec3 kPlace{2.9f, 0.001f, 2}, kUp{0, 1, 0};

size_t numberOf(const Lights& lights, const LightSample& s) {
  return s.lamp >= 0 ? static_cast<size_t>(s.lamp) : lights.lampCount() + static_cast<size_t>(s.emitter);
}

// Of few lights each is known, of many groups are.
class VisibleLightsOf : public testing::TestWithParam<int> {};

TEST_P(VisibleLightsOf, whatAWallHidesIsSeldomChosen) {
  const TwoRooms rooms(GetParam());
  const Known known(rooms);
  const std::span<const LightPart> parts = known.visible.partsAt(kPlace, kUp);
  ASSERT_FALSE(parts.empty());
  const auto inOther = [](const LightSample& s) { return s.lamp >= GetParam() || s.emitter >= 2; };
  int other = 0, otherBlindly = 0;
  for (uint32_t k = 0; k < 2000; ++k) {
    Sampler sampler(5, k, 0);
    const Vec2 u = sampler.next2();
    const float choice = sampler.next1();
    other += inOther(sampleLocal(known.lights, parts, kPlace, u, choice)) ? 1 : 0;
    otherBlindly += inOther(sampleLocal(known.lights, {}, kPlace, u, choice)) ? 1 : 0;
  }
  EXPECT_GT(otherBlindly, 600);
  EXPECT_LT(other, otherBlindly / 3);
  EXPECT_GT(other, 0);  // whatever was found, nothing is left out
}

TEST_P(VisibleLightsOf, chancesAreThoseOfTheChoiceAndAddUpToAll) {
  const TwoRooms rooms(GetParam());
  const Known known(rooms);
  const std::span<const LightPart> parts = known.visible.partsAt(kPlace, kUp);
  ASSERT_FALSE(parts.empty());
  const auto pdfThere = [&](const LightSample& s, const auto& pdfOf) {
    const Hit hit = known.rays.intersect({kPlace + s.wi * (s.distance - 0.01f), s.wi, 0, 0.02f});
    return hit.valid() ? static_cast<double>(pdfOf(surfaceAt(known.rays.scene(), hit, s.wi))) : 0;
  };
  std::vector<double> chance(known.lights.lampCount() + known.lights.emitterCount()), chosen(chance.size());
  int compared = 0;
  for (uint32_t k = 0; k < kSamples; ++k) {
    Sampler sampler(5, k, 0);
    const Vec2 u = sampler.next2();
    const float choice = sampler.next1();
    const LightSample s = sampleLocal(known.lights, parts, kPlace, u, choice);
    const size_t i = numberOf(known.lights, s);
    chosen[i] += 1.0 / kSamples;
    if (s.lamp >= 0)
      chance[i] =
          static_cast<double>(luminance(known.lights.sampleLamp(i, kPlace, {}).radiance) / luminance(s.radiance));
    // Of a mesh from any of its points, behind the wall too.
    if (s.emitter >= 0 && s.valid())
      chance[i] = pdfThere(s, [&](const SurfacePoint& q) { return pdfLocal(known.lights, parts, kPlace, q); }) /
                  pdfThere(s, [&](const SurfacePoint& q) {
                    return known.lights.pdfEmitter(static_cast<size_t>(s.emitter), kPlace, q);
                  });
    if (k < 2000)
      compared +=
          test::expectDensityOfItsPoint(known.rays, kPlace, s,
                                        [&](const SurfacePoint& p) { return pdfLocal(known.lights, parts, kPlace, p); })
              ? 1
              : 0;
  }
  EXPECT_GT(compared, 300);
  double sum = 0;
  for (size_t i = 0; i < chance.size(); ++i) {
    EXPECT_NEAR(chosen[i], chance[i], 0.01) << i;
    sum += chance[i];
  }
  EXPECT_NEAR(sum, 1, 0.01);
}

// Of a path's light, whatever is learned.
TEST_P(VisibleLightsOf, theMeanStays) {
  const TwoRooms rooms(GetParam());
  const Known known(rooms);
  const VisibleLights blind(known.lights);
  const CameraRays cameraRays(rooms.camera, kWidth, kHeight);
  double mean[2] = {}, square[2] = {};
  for (const bool learned : {false, true}) {
    const PathWalk walk(known.rays, known.lights, learned ? known.visible : blind);
    uint64_t rays = 0;
    for (uint32_t k = 0; k < kSamples; ++k) {
      Sampler sampler(k, 0, 3);
      const double v =
          luminance(walk.radiance(cameraRays.ray(sampler.next1() * kWidth, sampler.next1() * kHeight), sampler, rays));
      mean[learned] += v / kSamples, square[learned] += v * v / kSamples;
    }
  }
  const double variance = (square[0] - mean[0] * mean[0] + square[1] - mean[1] * mean[1]) / kSamples;
  EXPECT_NEAR(mean[1], mean[0], 3 * std::sqrt(variance));
}

INSTANTIATE_TEST_SUITE_P(, VisibleLightsOf, testing::Values(1, 100),
                         [](const auto& one) { return std::to_string(one.param) + "LampsARoom"; });

TEST(VisibleLights, sameBitsWithAnyNumberOfThreads) {
  const TwoRooms rooms;
  const RayScene rays(rooms.scene);
  const Lights lights(rooms.scene);
  PathSettings settings;
  settings.width = kWidth, settings.height = kHeight, settings.samples = 2;
  std::vector<Image> images;
  for (const int threads : {1, 4})
    withThreads(threads, [&] { images.push_back(pathTrace(rays, lights, rooms.camera, settings).image); });
  EXPECT_TRUE(images[0].pixels == images[1].pixels);
}

TEST(VisibleLights, knowNothingOnceStopped) {
  const TwoRooms rooms;
  const RayScene rays(rooms.scene);
  const Lights lights(rooms.scene);
  VisibleLights visible(lights);
  std::atomic<int> asked = 0;
  visible.learn(rays, {CameraRays(rooms.camera, kWidth, kHeight), kWidth, kHeight}, 4000, 1,
                [&] { return ++asked > 10; });
  EXPECT_EQ(visible.cellCount(), 0u);
  EXPECT_TRUE(visible.partsAt(kPlace, kUp).empty());
}

TEST(VisibleLights, knowNothingOfOneLight) {
  Scene scene;
  test::addRoom(scene, {0, 0, 0}, {3, 2.5f, 4}, std::vector<int>(6, test::addMaterial(scene, test::lambertian(0.5f))));
  scene.lamps.push_back(test::pointLamp({1, 2, 2}, 100));
  TwoRooms one(0);
  one.scene = scene;
  EXPECT_EQ(Known(one).visible.cellCount(), 0u);
}

}  // namespace
}  // namespace roomlight
