#include "gather/hit_cache.h"

#include <gtest/gtest.h>

#include "support/rooms.h"

namespace roomlight {
namespace {

constexpr float kCellM = 0.1f, kVoxelM = 0.2f;

HitPlace onFloor(float x, float z, uint32_t instance = 0) { return {{x, 0, z}, {0, 1, 0}, instance}; }

LitHit lit(const HitPlace& at, float radiance, bool sure = true) {
  LitHit hit;
  hit.at = at, hit.albedo = Vec3(1), hit.even = hit.own = Vec3(radiance), hit.sure = sure;
  return hit;
}

// A floor, and a wall as thin as a sheet on it at x = 0.53.
Scene partedFloor() {
  Scene scene;
  const int grey = test::addMaterial(scene, test::lambertian(0.5f));
  test::addRectangle(scene, {-2, 0, -2}, {0, 0, 4}, {4, 0, 0}, grey);
  test::addRectangle(scene, {0.53f, 0, -2}, {0, 2, 0}, {0, 0, 4}, grey);
  return scene;
}

TEST(HitCache, knowsTheMeanOfItsSamples) {
  const Scene scene = partedFloor();
  HitCache cache(kCellM, kVoxelM);
  std::vector<LitHit> samples;
  for (int i = 0; i < 8; ++i) samples.push_back(lit(onFloor(0.001f * static_cast<float>(i), 0), i < 4 ? 1.0f : 3.0f));
  cache.fill(RayScene(scene), samples);
  const HitCell* cell = cache.find(onFloor(0.003f, 0));
  ASSERT_NE(cell, nullptr);
  EXPECT_NEAR(cell->radianceCdM2.x, 2, 1e-5f);
  EXPECT_NEAR(cell->lux, 2 * kPi, 1e-4f);
  EXPECT_TRUE(cell->sure);
}

TEST(HitCache, knowsNothingOfOtherSidesThingsAndPlaces) {
  const Scene scene = partedFloor();
  HitCache cache(kCellM, kVoxelM);
  const std::vector<LitHit> samples(8, lit(onFloor(0, 0), 1));
  cache.fill(RayScene(scene), samples);
  EXPECT_NE(cache.find(onFloor(0, 0)), nullptr);
  EXPECT_EQ(cache.find({{0, 0, 0}, {0, -1, 0}, 0}), nullptr);
  EXPECT_EQ(cache.find(onFloor(0, 0, 1)), nullptr);
  EXPECT_EQ(cache.find(onFloor(1, 0)), nullptr);
}

TEST(HitCache, placesSeldomHitShareLargerCells) {
  const Scene scene = partedFloor();
  HitCache cache(kCellM, kVoxelM);
  const std::vector<LitHit> samples(1, lit(onFloor(0, 0), 1));
  cache.fill(RayScene(scene), samples);
  const HitCell* cell = cache.find(onFloor(0, 0));
  ASSERT_NE(cell, nullptr);
  EXPECT_FLOAT_EQ(cell->sizeM, 4 * kCellM);
  EXPECT_FALSE(cell->sure);  // reaches beyond the voxel that its sample was sure of
}

// One cell has samples of both sides of the wall: those that no free way leads to from its place are not in its mean.
TEST(HitCache, keepsTheTwoSidesOfAWallApart) {
  const Scene scene = partedFloor();
  HitCache cache(0.4f, kVoxelM);
  std::vector<LitHit> samples;
  for (int i = 0; i < 8; ++i) samples.push_back(lit(onFloor(i < 4 ? 0.5f : 0.56f, 0), i < 4 ? 100.0f : 0.0f, false));
  const RayScene rays(scene);
  cache.fill(rays, samples);
  const HitCell* cell = cache.find(onFloor(0.5f, 0));
  ASSERT_NE(cell, nullptr);
  ASSERT_EQ(cell, cache.find(onFloor(0.56f, 0)));
  EXPECT_NEAR(cell->radianceCdM2.x, 100, 1e-3f);
  EXPECT_FALSE(cell->sure);
  EXPECT_GT(luminance(rays.transmittance(HitCache::between(*cell, onFloor(0.45f, 0)))), 0.99f);
  EXPECT_EQ(luminance(rays.transmittance(HitCache::between(*cell, onFloor(0.56f, 0)))), 0);
}

TEST(HitCache, choosesAtMostSoManyOfACell) {
  const HitCache cache(kCellM, kVoxelM);
  std::vector<HitPlace> places(100, onFloor(0, 0));
  places.resize(103, onFloor(1, 0));
  const std::vector<HitCache::Chosen> chosen = cache.chosen(places, 10);
  EXPECT_EQ(chosen.size(), 13u);
  EXPECT_EQ(std::count_if(chosen.begin(), chosen.end(), [](const HitCache::Chosen& c) { return c.place >= 100; }), 3);
  for (const HitCache::Chosen& c : chosen) EXPECT_FLOAT_EQ(c.rays, c.place < 100 ? 10 : 1);
}

}  // namespace
}  // namespace roomlight
