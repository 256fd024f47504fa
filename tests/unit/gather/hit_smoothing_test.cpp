#include "gather/hit_cache.h"

#include <gtest/gtest.h>

#include "base/sampler.h"
#include "support/rooms.h"

namespace roomlight {
namespace {

constexpr float kCellM = 0.05f;

// A floor, and a wall as thin as a sheet on it at x = 0.
Scene partedFloor() {
  Scene scene;
  const int grey = test::addMaterial(scene, test::lambertian(0.5f));
  test::addRectangle(scene, {-4, 0, -4}, {0, 0, 8}, {8, 0, 0}, grey);
  test::addRectangle(scene, {0, 0, -4}, {0, 2, 0}, {0, 0, 8}, grey);
  return scene;
}

// Places all over the floor, each lit by one noisy sample of `light` there.
template <class Light>
std::vector<LitHit> noisyFloor(size_t count, Light&& light) {
  std::vector<LitHit> samples(count);
  for (size_t i = 0; i < count; ++i) {
    Sampler sampler(i, 0, 7);
    const Vec2 u = sampler.next2(), noise = sampler.next2();
    const Vec3 p{4 * u.x - 2, 0, 4 * u.y - 2};
    samples[i].at = {p, {0, 1, 0}, 0};
    samples[i].albedo = Vec3(1),
    samples[i].even = Vec3(light(p) * (noise.x < 0.25f ? 4.0f : 0.0f));  // relative variance 3
  }
  return samples;
}

struct Error {
  double mean = 0, square = 0;  // of means over cells, relative
};
template <class Light>
Error errorOf(std::span<const LitHit> samples, Light&& light, float least = -4, float most = 4) {
  Error e;
  double n = 0;
  for (const LitHit& s : samples) {
    if (s.at.p.x < least || s.at.p.x > most) continue;
    const double off = static_cast<double>(luminance(s.even + s.rare) / light(s.at.p)) - 1;
    e.mean += off, e.square += off * off, n += 1;
  }
  return {e.mean / n, e.square / n};
}

TEST(HitSmoothing, neighboursTellTheLight) {
  const Scene scene = partedFloor();
  const auto light = [](Vec3) { return 10.0f; };
  std::vector<LitHit> samples = noisyFloor(20000, light);
  const double before = errorOf(samples, light).mean;
  smoothLight(RayScene(scene), HitCache(kCellM, 2 * kCellM), samples);
  const Error after = errorOf(samples, light);
  EXPECT_LT(after.square, 0.1);  // 3 before
  EXPECT_NEAR(after.mean, before, 1e-3);
}

// A pool of light of a metre, sixteen times as bright: neither lost nor spread over the floor.
TEST(HitSmoothing, whatStandsOutStays) {
  const Scene scene = partedFloor();
  const auto light = [](Vec3 p) { return length(p - Vec3{1, 0, 1}) < 0.5f ? 160.0f : 10.0f; };
  std::vector<LitHit> samples = noisyFloor(40000, light);
  smoothLight(RayScene(scene), HitCache(kCellM, 2 * kCellM), samples);
  double in = 0, count = 0, beside = 0, others = 0;
  for (const LitHit& s : samples) {
    const float distance = length(s.at.p - Vec3{1, 0, 1}), l = luminance(s.even + s.rare);
    if (distance < 0.3f) in += static_cast<double>(l), count += 1;
    if (distance > 0.9f && distance < 1.4f) beside += static_cast<double>(l), others += 1;
  }
  EXPECT_NEAR(in / count, 160, 24);
  EXPECT_NEAR(beside / others, 10, 2);
}

TEST(HitSmoothing, keepsTheTwoSidesOfAWallApart) {
  const Scene scene = partedFloor();
  const auto light = [](Vec3 p) { return p.x < 0 ? 1000.0f : 0.1f; };
  std::vector<LitHit> samples = noisyFloor(20000, light);
  smoothLight(RayScene(scene), HitCache(kCellM, 2 * kCellM), samples);
  EXPECT_NEAR(errorOf(samples, light, 0.001f, 4).mean, 0, 0.1);
  EXPECT_NEAR(errorOf(samples, light, -4, -0.001f).mean, 0, 0.1);
}

// Places that many rays reach count for as many.
TEST(HitSmoothing, theMeanOverAllRaysStays) {
  const Scene scene = partedFloor();
  const auto light = [](Vec3 p) { return 20 + 5 * p.x; };
  std::vector<LitHit> samples = noisyFloor(20000, light);
  for (LitHit& s : samples) s.rays = s.at.p.x > 1 ? 20 : 1;
  const auto mean = [&] {
    double sum = 0, rays = 0;
    for (const LitHit& s : samples)
      sum += static_cast<double>(s.rays * luminance(s.even + s.rare)), rays += static_cast<double>(s.rays);
    return sum / rays;
  };
  const double before = mean();
  smoothLight(RayScene(scene), HitCache(kCellM, 2 * kCellM), samples);
  EXPECT_NEAR(mean(), before, 1e-3 * before);
}

}  // namespace
}  // namespace roomlight
