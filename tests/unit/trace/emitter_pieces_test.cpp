// Emissive meshes sampled by pieces: against sums over all triangles, and against a choice that does not look where
 // they shine.
#include "trace/emitter_pieces.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/light_densities.h"
#include "support/rooms.h"
#include "trace/lights.h"

namespace roomlight {
namespace {

constexpr uint32_t kSamples = 20'000;

Scene ball(bool doubleSided) {
  Scene scene;
  Material shining = test::lambertian(0, 1000);
  shining.doubleSided = doubleSided;
  test::addSphere(scene, {0, 0, 0}, 0.15f, test::addMaterial(scene, shining));
  return scene;
}

// A place around it.
Vec3 outside(Sampler& sampler) {
  Vec3 p;
  do p = Vec3{sampler.fast1(), sampler.fast1(), sampler.fast1()} * 1.6f - Vec3(0.8f);
  while (length(p) < 0.16f);
  return p;
}

struct Moments {
  double sum = 0, squares = 0;
  void add(double v) { sum += v, squares += v * v; }
  double mean() const { return sum / kSamples; }
  double deviation() const { return std::sqrt(std::max(0.0, squares / kSamples - mean() * mean())); }
};

double lux(const LightSample& light, Vec3 n) {
  return light.valid() ? static_cast<double>(luminance(light.radiance) * std::max(0.0f, dot(light.wi, n))) : 0;
}

TEST(EmitterPieces, giveTheLightOfAllTrianglesWithLessNoise) {
  for (const bool doubleSided : {false, true}) {
    const Scene scene = ball(doubleSided);
    const Lights lights(scene);
    const auto triangles = lights.emitterTriangles(0);
    for (const Vec3 p : {Vec3{0.5f, 0, 0}, Vec3{0.2f, -0.9f, 0.4f}, Vec3{-0.16f, 0.02f, 0}}) {
      const Vec3 n = normalize(-p);
      Moments pieces, all;
      for (uint32_t i = 0; i < kSamples; ++i) {
        Sampler sampler(3, i, 0);
        const Vec2 u = sampler.next2();
        const float choice = sampler.next1();
        pieces.add(lux(lights.sampleEmitter(0, p, u, choice), n));
        float before = 0;
        size_t t = 0;
        while (t + 1 < triangles.size() && choice >= before + triangles[t].share) before += triangles[t++].share;
        all.add(lux(lights.sampleEmitterTriangle(0, t, triangles[t].share, p, u), n));
      }
      const double deviation = std::hypot(pieces.deviation(), all.deviation()) / std::sqrt(double{kSamples});
      EXPECT_NEAR(pieces.mean(), all.mean(), 4 * deviation) << doubleSided << ' ' << p.x;
      EXPECT_LT(deviation, (length(p) > 0.2f ? 0.02 : 0.15) * all.mean());
      if (!doubleSided) {
        EXPECT_LT(pieces.deviation(), 0.75 * all.deviation()) << p.x;
      }
    }
  }
}

TEST(EmitterPieces, densityOfASampleIsThatOfItsPoint) {
  for (const bool doubleSided : {false, true}) {
    const Scene scene = ball(doubleSided);
    const Lights lights(scene);
    const RayScene rays(scene);
    Sampler sampler(6, 0, 7);
    int compared = 0;
    for (int k = 0; k < 500; ++k) {
      const Vec3 p = outside(sampler);
      const Vec2 u = sampler.next2();
      const LightSample s = lights.sampleEmitter(0, p, u, sampler.next1());
      compared +=
          test::expectDensityOfItsPoint(rays, p, s, [&](const SurfacePoint& q) { return lights.pdfEmitter(0, p, q); })
              ? 1
              : 0;
    }
    EXPECT_GT(compared, 100);
  }
}

// What shines towards a place is never left out, however little of it does.
TEST(EmitterPieces, allThatShinesTowardsAPlaceIsChosen) {
  const Scene scene = ball(false);
  const Lights lights(scene);
  const auto triangles = lights.emitterTriangles(0);
  std::vector<EmitterPieces::Part> parts;
  for (const auto& t : triangles) {
    Bounds3 bounds;
    for (const Vec3 v : {t.v.a, t.v.b, t.v.c}) bounds.add(v);
    parts.push_back({bounds, t.normal, t.share});
  }
  const EmitterPieces pieces(parts, false);
  ASSERT_EQ(pieces.order().size(), parts.size());
  Sampler sampler(6, 0, 7);
  for (int k = 0; k < 200; ++k) {
    const Vec3 p = outside(sampler);
    double sum = 0;
    for (uint32_t i = 0; i < parts.size(); ++i) {
      const EmitterPieces::Part& part = parts[pieces.order()[i]];
      const float chance = pieces.chanceOverShare(i, p) * part.share;
      sum += static_cast<double>(chance);
      const auto& t = triangles[pieces.order()[i]];
      if (dot(t.normal, p - t.v.a) > 1e-4f) {
        EXPECT_GT(chance, 0) << k << ' ' << i;
      }
    }
    EXPECT_NEAR(sum, 1, 1e-3) << k;
  }
}

}  // namespace
}  // namespace roomlight
