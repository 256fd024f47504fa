// Noise leaves the light of a wall, and its charts do not show.
#include "bake/smooth.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/sampler.h"
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

BakedLayer smoothed(const Scene& scene, const Atlas& atlas, BakedLayer layer, std::vector<uint8_t> buried = {}) {
  std::vector<BakedLayer> layers{std::move(layer)};
  buried.resize(atlas.elements.size());
  const RayScene rays(scene);
  Smoothing(atlas, buried, rays).smooth(atlas, layers);
  return layers[0];
}

// The light of `lux`, and of each element an error of so many lux that it does not have.
template <class LuxAt>
BakedLayer doubted(const Atlas& atlas, LuxAt luxAt, float errorLux) {
  BakedLayer layer = layerOf(atlas, luxAt, 0);
  std::fill(layer.errorLux.begin(), layer.errorLux.end(), errorLux);
  return layer;
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
  for (const float texelM : {0.025f, 0.05f, 0.12f}) {
    AtlasSettings settings;
    settings.texelM = texelM;
    const Atlas atlas = atlasOfAll(scene, settings);
    ASSERT_EQ(atlas.charts.size(), 2u);
    const BakedLayer noisy = layerOf(atlas, fallingLux, 0.05f);
    ASSERT_GT(largestStep(atlas, noisy), 0.05f);
    EXPECT_LT(largestStep(atlas, smoothed(scene, atlas, noisy)), 0.02f) << texelM;
  }
}

TEST(Smoothing, whatFallsOffEvenlyStaysAsItIs) {
  const Scene scene = wall();
  const Atlas atlas = atlasOfAll(scene);
  const BakedLayer before = doubted(atlas, fallingLux, 30), after = smoothed(scene, atlas, before);
  for (size_t i = 0; i < before.lux.size(); ++i)
    EXPECT_NEAR(after.lux[i].x, before.lux[i].x, 0.04f * before.lux[i].x) << atlas.elements[i].position.x;
}

// Root of the mean square of what is off, where `within`.
template <class Within>
double noiseLeft(const Atlas& atlas, const BakedLayer& layer, Within within) {
  double squares = 0, count = 0;
  for (size_t i = 0; i < layer.lux.size(); ++i) {
    const Vec3 p = atlas.elements[i].position;
    if (!within(p)) continue;
    squares += std::pow(static_cast<double>(layer.lux[i].x / fallingLux(p)) - 1, 2), count += 1;
  }
  return std::sqrt(squares / count);
}

TEST(Smoothing, noiseLeavesTheLightThatItWasIn) {
  const Scene scene = wall();
  const Atlas atlas = atlasOfAll(scene);
  const BakedLayer after = smoothed(scene, atlas, layerOf(atlas, fallingLux, 0.05f));
  EXPECT_LT(noiseLeft(atlas, after, [](Vec3) { return true; }), 0.02);
  // And edges that nothing goes on beyond.
  EXPECT_LT(noiseLeft(atlas, after, [](Vec3 p) { return p.y < 0.03f || p.y > 1.97f; }), 0.03);
}

// Two rooms under one ceiling: what is lit on one side of a wall does not light the other.
TEST(Smoothing, nothingPassesAWallBetween) {
  Scene scene = wall();
  addRectangle(scene, {kSeam, 0, -0.1f}, {0, 2, 0}, {0, 0, 1}, 0);
  const Atlas atlas = atlasOfAll(scene);
  const auto lit = [](Vec3 p) { return p.x < kSeam ? 100.0f : 110.0f; };
  const BakedLayer after = smoothed(scene, atlas, doubted(atlas, lit, 20));
  for (const uint32_t chart : {0u, 1u}) {
    forEachOf(atlas, chart, [&](size_t i, Vec3 p) { EXPECT_NEAR(after.lux[i].x, lit(p), 1e-3f); });
  }
}

// Within a hollow wall ceilings of two rooms meet, where nobody sees it.
TEST(Smoothing, nothingPassesWhatIsBuried) {
  const Scene scene = wall();
  const Atlas atlas = atlasOfAll(scene);
  const auto lit = [](Vec3 p) { return p.x < kSeam ? 100.0f : 110.0f; };
  std::vector<uint8_t> buried;
  for (const SurfaceElement& e : atlas.elements) buried.push_back(std::abs(e.position.x - kSeam) < 0.4f);
  const BakedLayer after = smoothed(scene, atlas, doubted(atlas, lit, 20), buried);
  for (const uint32_t chart : {0u, 1u}) {
    forEachOf(atlas, chart, [&](size_t i, Vec3 p) { EXPECT_NEAR(after.lux[i].x, lit(p), 1e-3f); });
  }
}

TEST(Smoothing, lightThatSomethingPartsStaysApart) {
  const Scene scene = wall();
  const Atlas atlas = atlasOfAll(scene);
  for (const float ratio : {1.45f, 1.55f}) {
    const auto lit = [&](Vec3 p) { return p.x < kSeam ? 100.0f : 100.0f * ratio; };
    const BakedLayer after = smoothed(scene, atlas, doubted(atlas, lit, 0));
    const float step = largestStep(atlas, after) * fallingLux({kSeam, 0, 0});
    if (ratio < 1.5f) {
      EXPECT_LT(step, 1);
    } else {
      EXPECT_GT(step, 50);
    }
  }
}

}  // namespace
}  // namespace roomlight::bake
