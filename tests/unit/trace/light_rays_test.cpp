#include "trace/light_rays.h"

#include <gtest/gtest.h>

#include "base/sampling.h"
#include "support/rooms.h"

namespace roomlight {
namespace {

constexpr uint32_t kRays = 1 << 20;

struct Shot {
  double lumens = 0, byLamps = 0, onPatch = 0;  // onPatch: part of all rays that land on it
};

// Where rays go: a patch of this half-width around p, normal n, if nothing stands between.
Shot shoot(const LightRays& light, Vec3 p, Vec3 n, float half) {
  Shot shot;
  const Frame frame(n);
  for (uint32_t i = 0; i < kRays; ++i) {
    Sampler sampler(5, i, 0);
    const LightRay ray = light.sample(sampler);
    const double lm = static_cast<double>(luminance(ray.fluxLm)) / kRays;
    EXPECT_EQ(ray.lamp >= 0, ray.emitter < 0);
    shot.lumens += lm, shot.byLamps += ray.lamp >= 0 ? lm : 0;
    const float down = -dot(ray.direction, n);
    if (down <= 0) continue;
    const float t = dot(ray.origin - p, n) / down;
    const Vec3 local = frame.toLocal(ray.origin + ray.direction * t - p);
    if (t > 0 && std::abs(local.x) < half && std::abs(local.y) < half) shot.onPatch += 1.0 / kRays;
  }
  return shot;
}

TEST(LightRays, leaveLampsAndSmallMeshesInProportionToFlux) {
  Scene scene;
  const int bright = test::addMaterial(scene, test::lambertian(0, 5000)),
            dim = test::addMaterial(scene, test::lambertian(0, 100));
  test::addSphere(scene, {0, 2, 0}, 0.05f, bright);
  test::addRectangle(scene, {1, 2, 0}, {0.2f, 0, 0}, {0, 0, 0.3f}, bright);
  test::addRectangle(scene, {-4, 3, -4}, {8, 0, 0}, {0, 0, 8}, dim);  // a glowing ceiling
  scene.lamps.push_back(test::pointLamp({2, 1, 2}, 30));
  const Lights lights(scene);
  const LightRays light(lights);
  EXPECT_TRUE(light.leaveEmitter(0) && light.leaveEmitter(1));
  EXPECT_FALSE(light.leaveEmitter(2));
  EXPECT_FALSE(light.hasAllLight());
  const double lamps = 4 * std::numbers::pi * 30,
               meshes = static_cast<double>(lights.emitterFluxLm(0) + lights.emitterFluxLm(1));
  const Shot shot = shoot(light, {0, 0, 0}, {0, 1, 0}, 1);
  EXPECT_NEAR(shot.lumens, lamps + meshes, 1e-3 * (lamps + meshes));
  EXPECT_NEAR(shot.byLamps, lamps, 3e-3 * lamps);
}

// Black and white halves, and a surface that shines to both sides: what leaves is what there is.
TEST(LightRays, holdTheLightOfTexturesAndOfBothSides) {
  for (const bool doubleSided : {false, true}) {
    Scene scene;
    Material m = test::lambertian(0.5f, 400);
    m.doubleSided = doubleSided;
    m.emissionTexture.texture = 0;
    test::addRectangle(scene, {0, 0, 0}, {0.4f, 0, 0}, {0, 0.4f, 0}, test::addMaterial(scene, m));
    scene.meshes[0].uv[0] = {{0, 0}, {1, 0}, {0, 1}, {1, 1}};
    scene.textures.push_back({"quarter", 64, 1, Wrap::ClampToEdge, Wrap::ClampToEdge, {}});
    for (int x = 0; x < 64; ++x) {
      for (int c = 0; c < 4; ++c) scene.textures[0].rgba.push_back(c == 3 || x >= 48 ? uint8_t{255} : uint8_t{0});
    }
    const Lights lights(scene);
    const LightRays light(lights);
    ASSERT_TRUE(light.leaveEmitter(0));
    EXPECT_TRUE(light.hasAllLight());
    // A quarter of 0.16 m2; the texel between black and white is read half by either.
    const double expected = std::numbers::pi * 400 * 0.16 * 0.25 * (doubleSided ? 2 : 1);
    EXPECT_NEAR(shoot(light, {0.2f, 0.2f, 1}, {0, 0, -1}, 1).lumens, expected, 0.01 * expected);
  }
}

struct Place {
  const char* name;
  Vec3 p, n;
  float half;
  double tolerance;
};

// The mean of what is predicted over the patch.
double predicted(const LightRays& light, const Place& place) {
  constexpr int kCells = 8;
  const Frame frame(place.n);
  double sum = 0;
  for (int i = 0; i < kCells * kCells; ++i) {
    const float x = (static_cast<float>(i % kCells) + 0.5f) / kCells * 2 - 1,
                y = (static_cast<float>(i / kCells) + 0.5f) / kCells * 2 - 1;
    sum += static_cast<double>(light.densityM2(place.p + frame.toWorld({x * place.half, y * place.half, 0}), place.n)) /
           (kCells * kCells);
  }
  return sum;
}

// Counts have a standard error of 1 / sqrt(count), of which three are allowed, and the tolerance.
void expectDensities(const Scene& scene, std::initializer_list<Place> places) {
  const Lights lights(scene);
  const LightRays light(lights);
  for (const Place& place : places) {
    const double counted = shoot(light, place.p, place.n, place.half).onPatch,
                 expected = predicted(light, place) * 4 * static_cast<double>(place.half * place.half);
    EXPECT_NEAR(expected / counted, 1, place.tolerance + 3 / std::sqrt(counted * kRays)) << place.name;
  }
}

// Of a ball the law of a point holds down to its surface; a flat one's cosine is known; a chandelier's bulbs are told
// apart.
TEST(LightRays, landAboutAsDenselyAsPredicted) {
  {
    Scene ball;
    test::addSphere(ball, {0, 1, 0}, 0.04f, test::addMaterial(ball, test::lambertian(0, 1000)), 48);
    expectDensities(ball, {{"below", {0, 0, 0}, {0, 1, 0}, 0.2f, 0.01},
                           {"aside", {0.8f, 0, 0}, {0, 1, 0}, 0.2f, 0.01},
                           {"close by", {0, 0.94f, 0}, {0, 1, 0}, 0.01f, 0.02}});
  }
  {
    Scene flat;
    test::addRectangle(flat, {-0.05f, 1, -0.05f}, {0.1f, 0, 0}, {0, 0, 0.1f},
                       test::addMaterial(flat, test::lambertian(0, 1000)));
    expectDensities(flat, {{"below", {0, 0, 0}, {0, 1, 0}, 0.2f, 0.01}, {"aside", {1, 0, 0}, {0, 1, 0}, 0.2f, 0.01}});
    const Lights lights(flat);
    EXPECT_EQ(LightRays(lights).densityM2({0, 2, 0}, {0, -1, 0}), 0) << "nothing goes back";
  }
  {
    // One mesh of two balls a metre apart.
    Scene two;
    test::addSphere(two, {-0.5f, 1, 0}, 0.04f, test::addMaterial(two, test::lambertian(0, 1000)));
    Mesh& mesh = two.meshes[0];
    const Mesh one = mesh;
    for (const uint32_t i : one.indices) mesh.indices.push_back(i + static_cast<uint32_t>(one.positions.size()));
    for (const Vec3 p : one.positions) mesh.positions.push_back(p + Vec3{1, 0, 0});
    mesh.normals.insert(mesh.normals.end(), one.normals.begin(), one.normals.end());
    expectDensities(two, {{"under one", {0.5f, 0.9f, 0}, {0, 1, 0}, 0.02f, 0.03},
                          {"between", {0, 0.5f, 0}, {0, 1, 0}, 0.2f, 0.03}});
  }
}

}  // namespace
}  // namespace roomlight
