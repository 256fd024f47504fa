#include "gather/layer_light.h"

#include <gtest/gtest.h>

#include "base/sampler.h"
#include "base/simd.h"
#include "support/rooms.h"

namespace roomlight {
namespace {

constexpr float kCellM = 0.1f, kVoxelM = 0.2f;
constexpr size_t kLayers = 3;

class LitFloor : public testing::Test {
 protected:
  LitFloor() {
    test::addRectangle(scene_, {-2, 0, -2}, {0, 0, 4}, {4, 0, 0}, test::addMaterial(scene_, test::lambertian(0.5f)));
  }

  // A sample at x whose light is `soft` of one layer and `sharp` of another.
  void add(float x, int32_t softLayer, float soft, int32_t sharpLayer = 0, float sharp = 0) {
    LitHit hit;
    hit.at = {{x, 0, 0}, {0, 1, 0}, 0}, hit.albedo = Vec3(0.5f);
    hit.even = Vec3(soft), hit.sharp = Vec3(sharp), hit.own = hit.even + hit.sharp;
    hit.sure = true, hit.number = static_cast<uint32_t>(samples_.size());
    samples_.push_back(hit);
    softLayers_.push_back(softLayer), sharpLayers_.push_back(sharpLayer);
  }
  // The shares of the cell there, of the red channel.
  std::vector<float> sharesAt(float x) {
    HitLayers layers(kLayers, samples_.size());
    LayerSums sums(kLayers);
    for (const LitHit& hit : samples_) {
      sums.resize(1);
      sums.add(0, LayerSums::kDiffuse, softLayers_[hit.number], hit.even),
          sums.add(0, LayerSums::kSharp, sharpLayers_[hit.number], hit.sharp);
      layers.take(hit.number, sums, 0);
    }
    HitCache cells(kCellM, kVoxelM);
    const RayScene rays(scene_);
    layers.smooth(rays, cells, samples_);
    cells.fill(rays, samples_, &layers);
    const HitCell* cell = cells.find({{x, 0, 0}, {0, 1, 0}, 0});
    EXPECT_NE(cell, nullptr);
    std::vector<float> out;
    for (size_t l = 0; l < kLayers; ++l) out.push_back(fromHalf(cells.shares(*cell)[l]));
    return out;
  }

  Scene scene_;
  std::vector<LitHit> samples_;
  std::vector<int32_t> softLayers_, sharpLayers_;
};

TEST_F(LitFloor, aCellHasTheSharesOfAllItsSamples) {
  for (int i = 0; i < 8; ++i) add(0.001f * static_cast<float>(i), i < 4 ? 0 : 1, i < 4 ? 1.0f : 3.0f);
  const std::vector<float> shares = sharesAt(0.003f);
  EXPECT_NEAR(shares[0], 0.25f, 1e-3f);
  EXPECT_NEAR(shares[1], 0.75f, 1e-3f);
  EXPECT_EQ(shares[2], 0);
}

// Two cells beside one another: what comes straight from lamps is each cell's own.
TEST_F(LitFloor, lightStraightFromLampsIsNotToldByNeighbours) {
  for (int i = 0; i < 4; ++i)
    add(0.001f * static_cast<float>(i), 0, 1, 2, 2), add(0.1f + 0.001f * static_cast<float>(i), 0, 1);
  const std::vector<float> lit = sharesAt(0.001f), beside = sharesAt(0.101f);
  EXPECT_NEAR(lit[0], 1 / 3.0f, 1e-3f);
  EXPECT_NEAR(lit[2], 2 / 3.0f, 1e-3f);
  EXPECT_NEAR(beside[0], 1, 1e-3f);
  EXPECT_EQ(beside[2], 0);
}

// Samples all over a floor, each lit by one of two layers by chance: cells come out near half and half, whatever their
// own samples found.
TEST_F(LitFloor, softLightIsToldByNeighbours) {
  Rng rng(7, 0, 1);
  for (int i = 0; i < 400; ++i) add(0.004f * static_cast<float>(i), rng.uniform() < 0.5f ? 0 : 1, 1);
  for (const float x : {0.3f, 0.7f, 1.1f}) {
    const std::vector<float> shares = sharesAt(x);
    EXPECT_NEAR(shares[0], 0.5f, 0.12f) << x;
    EXPECT_NEAR(shares[0] + shares[1], 1, 2e-3f) << x;
  }
}

}  // namespace
}  // namespace roomlight
