#include "reference/path_tracer.h"

#include <gtest/gtest.h>

#include <atomic>

#include "base/sampler.h"
#include "filter/blend.h"
#include "reference/path_walk.h"
#include "reference/pixel_sums.h"
#include "support/rooms.h"
#include "trace/camera_rays.h"

namespace roomlight {
namespace {

// A room with a box, half in the light of a lamp, and glossy walls; a pane before the camera where asked.
struct Room {
  Scene scene;
  Camera camera;
  explicit Room(bool pane = false) {
    Material walls = test::lambertian(0.6f);
    walls.specular = 1, walls.roughness = 0.4f;
    test::addRoom(scene, {0, 0, 0}, {4, 3, 4}, std::vector<int>(6, test::addMaterial(scene, walls)));
    test::addBox(scene, {1, 0, 1}, {2, 1.2f, 2}, test::addMaterial(scene, test::lambertian(0.3f)));
    scene.lamps.push_back(test::pointLamp({3, 2, 3}, 50));
    if (pane) {
      Material glass;
      glass.transmission = 1, glass.metallic = 0, glass.roughness = 0;
      test::addRectangle(scene, {0, 0, 3.5f}, {4, 0, 0}, {0, 3, 0}, test::addMaterial(scene, glass));
    }
    camera.worldFromCamera = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {2, 1.4f, 3.9f}};
    camera.yFovRad = 1.2f;
  }
};

PathSettings settingsOf(int size, int samples, uint64_t seed = 0) {
  PathSettings s;
  s.width = s.height = size;
  s.samples = samples, s.seed = seed;
  return s;
}

double meanSquare(const Image& a, const Image& b) {
  double sum = 0;
  for (size_t i = 0; i < a.pixels.size(); ++i) sum += lengthSquared(a.pixels[i] - b.pixels[i]) / 3;
  return sum / static_cast<double>(a.pixels.size());
}

// A sum in float is off by a thousandth here, and stands still after 2^24 samples.
TEST(PathTracer, keepsTheMeanOverManySamples) {
  Scene scene;
  Material shining = test::lambertian(0);
  shining.emission = Vec3(0.1f);
  test::addRoom(scene, {0, 0, 0}, {2, 2, 2}, std::vector<int>(6, test::addMaterial(scene, shining)));
  Camera camera;
  camera.worldFromCamera = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
  const RayScene rays(scene);
  const Lights lights(scene);
  PathSettings settings = settingsOf(1, 1);
  settings.lightPaths = false;
  PathTracer tracer(rays, lights, camera, settings);
  while (tracer.samples() < 50'000) tracer.pass();
  EXPECT_NEAR(tracer.mean().pixels[0].x, 0.1f, 1e-6f);
  EXPECT_LT(tracer.variance().pixels[0].x, 1e-12f);
}

TEST(PathFeatures, PartsMakeTheWholeAndTellWhatIsSeen) {
  for (const bool pane : {false, true}) {
    const Room room(pane);
    const RayScene rays(room.scene);
    const Lights lights(room.scene);
    LightVertices vertices(rays, lights);
    vertices.trace(1000, 0, 1);
    const VisibleLights visible(lights);
    const PathWalk walk(rays, lights, visible, &vertices);
    const CameraRays cameraRays(room.camera, 32, 32);
    uint64_t count = 0;
    int seen = 0;
    for (int i = 0; i < 1024; ++i) {
      Sampler one(static_cast<uint64_t>(i), 0, 0), two = one;
      const Ray ray = cameraRays.ray(static_cast<float>(i % 32) + 0.5f, static_cast<float>(i / 32) + 0.5f);
      FilterPixel p;
      const Vec3 all = walk.radiance(ray, one, count), again = walk.radiance(ray, two, count, p),
                 sum = p.diffuse + p.sharp + p.specular + p.rest;
      EXPECT_EQ(all, again);
      EXPECT_NEAR(luminance(sum), luminance(all), 1e-4f * luminance(all) + 1e-6f);
      if (p.surface <= 0) continue;
      ++seen;
      EXPECT_NEAR(length(p.normal), 1, 1e-4f);
      EXPECT_LT(p.position.z, 3.4f);
      EXPECT_GT(luminance(p.albedo), 0.1f);
    }
    EXPECT_GT(seen, pane ? 700 : 950);
  }
}

TEST(PathFeatures, VarianceIsThatOfTheMean) {
  Rng rng(1, 2, 3);
  double squares = 0, estimate = 0;
  constexpr int kTrials = 2000, kSamples = 8;
  for (int t = 0; t < kTrials; ++t) {
    PixelSums sums;
    for (int i = 0; i < kSamples; ++i) {
      FilterPixel p;
      p.albedo = Vec3(rng.uniform() < 0.5f ? 0.2f : 0.8f);
      p.diffuse = p.albedo * (3 + 2 * rng.uniform());
      p.surface = 1;
      sums.add(p);
    }
    const FilterPixel m = sums.mean(kSamples);
    const double off = luminance(m.diffuse) / luminance(m.albedo) - 4;
    squares += off * off, estimate += m.diffuseVariance;
  }
  EXPECT_NEAR(estimate, squares, 0.25 * squares);
}

TEST(PathTracer, PassesGiveThePictureOfPathTrace) {
  const Room room;
  const RayScene rays(room.scene);
  const Lights lights(room.scene);
  PathTracer tracer(rays, lights, room.camera, settingsOf(24, 0), true);
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(tracer.pass());
  const PathResult whole = pathTrace(rays, lights, room.camera, settingsOf(24, 3));
  EXPECT_EQ(tracer.mean().pixels, whole.image.pixels);
  EXPECT_EQ(tracer.variance().pixels, whole.variance.pixels);
  const std::atomic<bool> cancelled = true;
  EXPECT_FALSE(tracer.pass({{}, &cancelled}));
  EXPECT_EQ(tracer.samples(), 3);
}

TEST(PathTracer, FilterLowersTheErrorOfFewSamples) {
  const Room room;
  const RayScene rays(room.scene);
  const Lights lights(room.scene);
  const Image truth = pathTrace(rays, lights, room.camera, settingsOf(48, 512, 9)).image;
  PathSettings settings = settingsOf(48, 4);
  const double raw = meanSquare(pathTrace(rays, lights, room.camera, settings).image, truth);
  settings.filter = true;
  EXPECT_LT(meanSquare(pathTrace(rays, lights, room.camera, settings).image, truth), 0.4 * raw);
}

// The first picture is a filtered one, a fifth too dark. The estimate of what is left is too low by 2 to 4 here
// (docs/methods/filter.md).
TEST(PathTracer, BlendOfARoomConverges) {
  const Room room;
  const RayScene rays(room.scene);
  const Lights lights(room.scene);
  const Image truth = pathTrace(rays, lights, room.camera, settingsOf(48, 1024, 9)).image;
  PathSettings filtered = settingsOf(48, 4, 5);
  filtered.filter = true;
  Image first = pathTrace(rays, lights, room.camera, filtered).image;
  for (Vec3& p : first.pixels) p *= 0.8f;
  PathTracer tracer(rays, lights, room.camera, settingsOf(48, 0), true);
  double before = meanSquare(first, truth);
  for (const int samples : {4, 16, 64}) {
    while (tracer.samples() < samples) tracer.pass();
    const Blend b = blend(first, tracer.mean(), tracer.variance(), tracer.features());
    const double error = meanSquare(b.image, truth);
    EXPECT_LT(error, 0.9 * before) << samples;
    before = error;
    double mean = 0, relative = 0;
    for (const Vec3& p : truth.pixels) mean += luminance(p) / static_cast<double>(truth.pixels.size());
    for (size_t i = 0; i < truth.pixels.size(); ++i)
      relative += lengthSquared(b.image.pixels[i] - truth.pixels[i]) / 3 /
                  std::pow(luminance(truth.pixels[i]) + 0.05 * mean, 2);
    relative = std::sqrt(relative / static_cast<double>(truth.pixels.size()));
    EXPECT_LT(b.relativeError, 1.5 * relative) << samples;
    EXPECT_GT(b.relativeError, relative / 5) << samples;
  }
}

}  // namespace
}  // namespace roomlight
