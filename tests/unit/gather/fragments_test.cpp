// Edges: what a pixel shows of a second surface takes the filtered light of pixels beside it, of each layer its own.
#include <gtest/gtest.h>

#include "gather/pixel_shader.h"
#include "scene/primitives.h"

namespace roomlight {
namespace {

constexpr int kWidth = 6;
constexpr uint32_t kEdge = 2;  // shows the wall on its left, and a little of that on its right

FilterInput twoWalls() {
  FilterInput means(kWidth, 1);
  for (uint32_t x = 0; x < kWidth; ++x) {
    FilterPixel& p = means.pixels[x];
    const bool left = x <= kEdge;
    p.surface = 1, p.albedo = Vec3(1);
    p.normal = left ? Vec3{0, 0, 1} : Vec3{0, 1, 0};
    p.position = {0.1f * static_cast<float>(x), left ? 0.0f : 1.0f, 0};
  }
  return means;
}

Fragments ofTheRight(Vec3 place, Vec3 normal) {
  Fragment f{kEdge, Vec3(0.5f), Vec3(0.25f), normal, place};
  f.surface = 1;
  return {{f}, {Vec3(0.4f), Vec3(0.1f)}};
}

float shown(Fragments fragments, int layer, float irradianceRight) {
  const FilterInput means = twoWalls();
  const std::vector<PixelCount> counts(kWidth, PixelCount{4, 4, 4});
  std::vector<Vec3> irradiance(kWidth, Vec3(1));
  for (size_t x = kEdge + 1; x < kWidth; ++x) irradiance[x] = Vec3(irradianceRight);
  Image whole(kWidth, 1), image(kWidth, 1);
  addFragments(fragments, -1, means, counts, irradiance, whole);
  if (layer < 0) return whole.pixels[kEdge].y;
  addFragments(fragments, layer, means, counts, irradiance, image);
  return image.pixels[kEdge].y;
}

TEST(Fragments, takeTheLightOfTheirSurfaceBesideInEachLayer) {
  const Fragments f = ofTheRight({0.25f, 1, 0}, {0, 1, 0});
  for (const int layer : {-1, 0, 1}) EXPECT_FLOAT_EQ(shown(f, layer, 8), 8 * 0.25f / 4);
}

// No brighter together than what is around: their own light over albedo is 2, that of the layers 1.6 and .4.
TEST(Fragments, seenNowhereBesideHaveTheirOwnLightInEachLayer) {
  const Fragments f = ofTheRight({0.25f, 5, 0}, {1, 0, 0});
  EXPECT_FLOAT_EQ(shown(f, 0, 8), 1.6f * 0.25f / 4);
  EXPECT_FLOAT_EQ(shown(f, 1, 8), 0.4f * 0.25f / 4);
  EXPECT_FLOAT_EQ(shown(f, -1, 0.5f), 1 * 0.25f / 4);
  EXPECT_FLOAT_EQ(shown(f, 0, 0.5f), 0.8f * 0.25f / 4);
  EXPECT_FLOAT_EQ(shown(f, 1, 0.5f), 0.2f * 0.25f / 4);
}

// A pixel that sees two surfaces: the diffuse light of the second is no part of what stays unfiltered, in no layer.
TEST(Fragments, keepDiffuseLightOfLayersApart) {
  Scene scene;
  addRectangle(scene, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, addMaterial(scene, lambertian(0.5f)));
  const RayScene rays(scene);
  const Lights lights(scene);
  LightLayers layers;
  layers.layers.resize(2);
  LayerSums sums(layers.size()), light(layers.size());
  sums.resize(2), light.resize(2);
  const PictureSettings settings;
  const PixelShader shader(rays, lights, settings, true, &layers, &sums);
  std::vector<SurfaceLight> shaded(2);
  for (size_t s = 0; s < 2; ++s) {
    shaded[s].albedo = Vec3(0.5f), shaded[s].diffuse = Vec3(3), shaded[s].sharp = Vec3(1);
    light.add(s, LayerSums::kDiffuse, 0, Vec3(2)), light.add(s, LayerSums::kDiffuse, 1, Vec3(1)),
        light.add(s, LayerSums::kSharp, 0, Vec3(1));
  }
  std::array<FilterPixel, 2> pixels;
  std::array<PixelCount, 2> counts;
  Fragments fragments;
  for (const uint32_t pixel : {1u, 0u, 1u}) {  // passes: the third adds to the fragment of the first
    TileWork work;
    work.parts.push_back({{&pixels[pixel], &counts[pixel], pixel}, 0, 1, Vec3(1), 3, true});
    work.parts.back().normal = {0, 0, 3}, work.parts.back().surface = 3;
    work.parts.push_back({{&pixels[pixel], &counts[pixel], pixel}, 1, 1, Vec3(1), 1, true});
    work.parts.back().normal = {1, 0, 0}, work.parts.back().position = {0, 0, 1}, work.parts.back().surface = 1;
    PixelShader::add(work, shaded, &fragments);
    shader.addLayers(work, shaded, light, &fragments);
  }
  ASSERT_EQ(fragments.all.size(), 2u);
  for (size_t k = 0; k < 2; ++k) {
    const uint32_t pixel = fragments.all[k].pixel;
    const float passes = pixel == 1 ? 2 : 1;
    for (const int layer : {-1, 0, 1})
      EXPECT_EQ(fragments.diffuse(k, layer).x, passes * (layer < 0 ? 3 : static_cast<float>(2 - layer)));
    EXPECT_EQ(sums.get(pixel, LayerSums::kDiffuse, 0).x, 6 * passes);  // of the first surface alone
    EXPECT_EQ(sums.get(pixel, LayerSums::kRest, 0).x, passes);         // the sharp light of the second
    EXPECT_EQ(sums.get(pixel, LayerSums::kRest, 1).x, 0);
  }
}

}  // namespace
}  // namespace roomlight
