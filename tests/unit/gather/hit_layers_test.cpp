#include "gather/hit_layers.h"

#include <gtest/gtest.h>

#include "base/half.h"
#include "support/rooms.h"

namespace roomlight {
namespace {

constexpr float kCellM = 0.1f, kVoxelM = 0.2f;
constexpr size_t kLayers = 3;

class LitFloor : public testing::Test {
 protected:
  LitFloor() { test::addRectangle(scene_, {-2, 0, -2}, {0, 0, 4}, {4, 0, 0}, test::addMaterial(scene_, test::lambertian(0.5f))); }

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
      sums.add(0, LayerSums::kDiffuse, softLayers_[hit.number], hit.even), sums.add(0, LayerSums::kSharp, sharpLayers_[hit.number], hit.sharp);
      layers.take(hit.number, sums, 0);
    }
    HitCache cells(kCellM, kVoxelM);
    layers.share(cells, samples_);
    cells.fill(RayScene(scene_), samples_, &layers);
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

// Two cells beside one another, in one that is four times as large: soft light is shared as by both, light straight from lamps as by each.
TEST_F(LitFloor, softLightIsToldByNeighboursAndSharpLightIsNot) {
  for (int i = 0; i < 4; ++i) add(0.001f * static_cast<float>(i), 0, 1, 2, 2), add(0.1f + 0.001f * static_cast<float>(i), 1, 1);
  const std::vector<float> lit = sharesAt(0.001f), beside = sharesAt(0.101f);
  EXPECT_NEAR(lit[0], 1 / 6.0f, 1e-3f);
  EXPECT_NEAR(lit[1], 1 / 6.0f, 1e-3f);
  EXPECT_NEAR(lit[2], 2 / 3.0f, 1e-3f);
  EXPECT_NEAR(beside[0], 0.5f, 1e-3f);
  EXPECT_NEAR(beside[1], 0.5f, 1e-3f);
  EXPECT_EQ(beside[2], 0);
}

// A cell whose samples found nothing takes the shares of those further away: smoothing may give it some of their light.
TEST_F(LitFloor, aDarkCellHasTheSharesOfThoseAround) {
  for (int i = 0; i < 4; ++i) add(0.001f * static_cast<float>(i), 1, 0), add(0.6f + 0.001f * static_cast<float>(i), 1, 5);
  for (LitHit& hit : samples_) hit.sharp = {};
  HitLayers layers(kLayers, samples_.size());
  LayerSums sums(kLayers);
  for (const LitHit& hit : samples_) {
    sums.resize(1);
    sums.add(0, LayerSums::kDiffuse, 1, hit.even);
    layers.take(hit.number, sums, 0);
  }
  HitCache cells(kCellM, kVoxelM);
  layers.share(cells, samples_);
  for (LitHit& hit : samples_) hit.even = Vec3(1);  // as smoothed
  cells.fill(RayScene(scene_), samples_, &layers);
  const HitCell* dark = cells.find(samples_[0].at);
  ASSERT_NE(dark, nullptr);
  EXPECT_NEAR(fromHalf(cells.shares(*dark)[1]), 1, 1e-3f);
}

}  // namespace
}  // namespace roomlight
