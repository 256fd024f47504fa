// Noise leaves the light of a wall, and its charts do not show.
#include "bake/smooth.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/sampler.h"
#include "base/sampling.h"
#include "support/rooms.h"
#include "unit/bake/atlas_of_all.h"

namespace roomlight::bake {
namespace {

constexpr float kSeam = 1.03f;  // between two charts of a wall, along x

// A wall of 2 m x 2 m towards z, of two things that meet at kSeam.
Scene wall() {
  Scene scene;
  const int grey = addMaterial(scene, lambertian(0.5f));
  addRectangle(scene, {0, 0, 0}, {kSeam, 0, 0}, {0, 2, 0}, grey);
  addRectangle(scene, {kSeam, 0, 0}, {2 - kSeam, 0, 0}, {0, 2, 0}, grey);
  return scene;
}

// Light that falls by a third a metre.
float fallingLux(Vec3 p) { return 1000 * (1 - p.x / 3); }

// Of each element, with noise of so much of it.
template <class LuxAt>
BakedLayer layerOf(const Atlas& atlas, LuxAt luxAt, float noise) {
  BakedLayer layer;
  for (size_t i = 0; i < atlas.elements.size(); ++i) {
    Sampler sampler(i, 0, 0);
    const float lux = luxAt(atlas.elements[i].position);
    layer.lux.emplace_back(lux * (1 + noise * std::sqrt(12.0f) * (sampler.next1() - 0.5f)));
    layer.errorLux.push_back(noise * lux);
  }
  return layer;
}

BakedLayer smoothed(const Scene& scene, const Atlas& atlas, BakedLayer layer) {
  std::vector<BakedLayer> layers{std::move(layer)};
  const RayScene rays(scene);
  Smoothing(atlas, rays).smooth(atlas, layers);
  return layers[0];
}

template <class Use>
void forEachOf(const Atlas& atlas, uint32_t chart, Use use) {
  for (size_t i = 0; i < atlas.elements.size(); ++i) {
    if (atlas.chartOf[i] == chart) use(i, atlas.elements[i].position);
  }
}

// Between texels on both sides of the seam, at the same height, over the light there: the largest.
float largestStep(const Atlas& atlas, const BakedLayer& layer) {
  float largest = 0;
  const auto onSeam = [](Vec3 p) { return std::abs(p.x - kSeam) < 0.02f; };
  forEachOf(atlas, 0, [&](size_t i, Vec3 p) {
    forEachOf(atlas, 1, [&](size_t j, Vec3 q) {
      if (!onSeam(p) || !onSeam(q) || std::abs(p.y - q.y) > 1e-3f) return;
      largest = std::max(largest, std::abs(layer.lux[i].x - layer.lux[j].x) / fallingLux(p));
    });
  });
  return largest;
}

TEST(Smoothing, lightDoesNotStepWhereChartsMeet) {
  const Scene scene = wall();
  const Atlas atlas = atlasOfAll(scene);
  ASSERT_EQ(atlas.charts.size(), 2u);
  const BakedLayer noisy = layerOf(atlas, fallingLux, 0.05f);
  ASSERT_GT(largestStep(atlas, noisy), 0.1f);
  EXPECT_LT(largestStep(atlas, smoothed(scene, atlas, noisy)), 0.02f);
}

TEST(Smoothing, whatFallsOffEvenlyStaysAsItIs) {
  const Scene scene = wall();
  const Atlas atlas = atlasOfAll(scene);
  BakedLayer layer = layerOf(atlas, fallingLux, 0);
  std::fill(layer.errorLux.begin(), layer.errorLux.end(), 100.0f);
  const BakedLayer after = smoothed(scene, atlas, layer);
  for (size_t i = 0; i < layer.lux.size(); ++i)
    EXPECT_NEAR(after.lux[i].x, layer.lux[i].x, 0.02f * layer.lux[i].x) << atlas.elements[i].position.x;
}

TEST(Smoothing, noiseLeavesTheLightThatItWasIn) {
  const Scene scene = wall();
  const Atlas atlas = atlasOfAll(scene);
  const BakedLayer after = smoothed(scene, atlas, layerOf(atlas, fallingLux, 0.05f));
  double squares = 0;
  for (size_t i = 0; i < after.lux.size(); ++i)
    squares += std::pow(static_cast<double>(after.lux[i].x / fallingLux(atlas.elements[i].position)) - 1, 2);
  EXPECT_LT(std::sqrt(squares / static_cast<double>(after.lux.size())), 0.02);
}

// Two rooms under one ceiling: what is lit on one side of a wall does not light the other.
TEST(Smoothing, nothingPassesAWallBetween) {
  Scene scene = wall();
  addRectangle(scene, {kSeam, 0, -0.1f}, {0, 2, 0}, {0, 0, 1}, 0);
  const Atlas atlas = atlasOfAll(scene);
  const auto lit = [](Vec3 p) { return p.x < kSeam ? 100.0f : 110.0f; };
  BakedLayer layer = layerOf(atlas, lit, 0);
  std::fill(layer.errorLux.begin(), layer.errorLux.end(), 20.0f);
  const BakedLayer after = smoothed(scene, atlas, layer);
  for (const uint32_t chart : {0u, 1u}) {
    forEachOf(atlas, chart, [&](size_t i, Vec3 p) { EXPECT_NEAR(after.lux[i].x, lit(p), 1e-3f); });
  }
}

}  // namespace
}  // namespace roomlight::bake
