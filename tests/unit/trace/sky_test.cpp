#include <gtest/gtest.h>

#include "base/sampler.h"
#include "trace/lights.h"

namespace roomlight {
namespace {

// A blue sky, brighter below; with a sun of some texels.
Sky skyWithSun(float sunCdM2) {
  Sky sky;
  sky.image = Image(256, 128);
  for (int y = 0; y < 128; ++y) {
    for (int x = 0; x < 256; ++x) sky.image.at(x, y) = Vec3{2000, 3000, 5000} + Vec3(10) * static_cast<float>(y);
  }
  for (int y = 40; y < 42; ++y) {
    for (int x = 70; x < 72; ++x) sky.image.at(x, y) = Vec3{1, 0.9f, 0.8f} * sunCdM2;
  }
  return sky;
}

// On a horizontal plane under the sky, lx, by `n` samples of each strategy.
Vec3 illuminance(const Lights& lights, uint32_t n) {
  Vec3 sum;
  const auto add = [&](const LightSample& s) {
    if (s.wi.y > 0) sum += s.radiance * (s.wi.y / static_cast<float>(n));
  };
  for (uint32_t i = 0; i < n; ++i) {
    Sampler sampler(0, i, 3);
    add(lights.sampleSky(sampler.next2()));
    for (size_t k = 0; k < lights.sunCount(); ++k) add(lights.sampleSun(k, sampler.next2()));
  }
  return sum;
}

TEST(Sky, sunApartLeavesTheLightAsItIs) {
  Scene scene;
  scene.sky = skyWithSun(5e7f);
  const Lights whole(scene), apart(scene, true);
  ASSERT_EQ(whole.sunCount(), 0u);
  ASSERT_EQ(apart.sunCount(), 1u);
  const Vec3 expected = illuminance(whole, 1 << 16), measured = illuminance(apart, 1 << 16);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(measured[c], expected[c], 0.01f * expected[c]) << c;
}

TEST(Sky, sunApartIsSeenWhereItIs) {
  Scene scene;
  scene.sky = skyWithSun(5e7f);
  const Lights lights(scene, true);
  for (uint32_t i = 0; i < 256; ++i) {
    Sampler sampler(0, i, 5);
    const LightSample s = lights.sampleSun(0, sampler.next2());
    float pdf = 0;
    const Vec3 seen = lights.sunDisc(0, s.wi, pdf);
    // Directions by the rim may be rounded into the next cell.
    if (pdf == 0) continue;
    EXPECT_NEAR(luminance(s.radiance) * s.pdf, luminance(seen), 0.2f * luminance(seen));
    EXPECT_TRUE(isBlack(lights.sky().radiance(s.wi)));
  }
}

// Blocks together are the whole sky, each sample with the density that its direction has in it.
TEST(Sky, blocksAreDrawnWithTheDensityThatIsTold) {
  const Sky image = skyWithSun(2e5f);
  const SkyDistribution sky(image);
  constexpr uint32_t kSamples = 64;
  Vec3 sum;
  for (int block = 0; block < SkyDistribution::kBlocks; ++block) {
    for (uint32_t i = 0; i < kSamples; ++i) {
      const SkyDistribution::Sample s = sky.sampleBlock(block, Sampler(static_cast<uint64_t>(block), i, 7).next2());
      ASSERT_EQ(sky.blockAt(s.uv), block);
      ASSERT_NEAR(s.pdf, sky.pdfAt(s.uv), 1e-3f * s.pdf) << block;
      sum += sky.radianceAt(s.uv) * (sky.blockShare(block) / (s.pdf * static_cast<float>(kSamples)));
    }
  }
  const Vec3 whole = sky.mean() * (4 * kPi);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(sum[c], whole[c], 5e-3f * whole[c]) << c;
}

TEST(Sky, cloudsAreNoSun) {
  Scene scene;
  scene.sky = skyWithSun(9000);
  EXPECT_EQ(Lights(scene, true).sunCount(), 0u);
}

}  // namespace
}  // namespace roomlight
