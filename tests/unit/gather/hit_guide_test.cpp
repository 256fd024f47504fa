// Guides only choose directions: their densities must be those of what they draw, and what they draw must go to what is
// bright.
#include "gather/hit_guide.h"

#include <gtest/gtest.h>

#include "base/random.h"
#include "base/sampling.h"

namespace roomlight {
namespace {

constexpr float kRegionM = 0.6f, kClusterM = 0.4f;
constexpr Vec3 kFrom{0.1f, 0, 0.1f}, kUp{0, 1, 0}, kBright{1.5f, 2, 0.3f};

// Rays from a floor to a ceiling 2 m above: bright within 0.2 m of one place, dim elsewhere.
std::vector<GuideRay> raysToCeiling(int count) {
  std::vector<GuideRay> rays;
  Rng rng(1, 2, 3);
  for (int i = 0; i < count; ++i) {
    const Vec3 local = sampleCosineHemisphere(rng.uniform2()), d{local.x, local.z, local.y};
    GuideRay ray;
    ray.from = kFrom, ray.normal = kUp, ray.arrives = true, ray.to = kFrom + d * (2 / std::max(d.y, 0.05f)),
    ray.weight = 1;
    ray.light = length(ray.to - kBright) < 0.2f ? 100.0f : 1.0f;
    rays.push_back(ray);
  }
  return rays;
}

TEST(HitGuide, sendsRaysToWhatIsBright) {
  const HitGuide guide(raysToCeiling(4000), kRegionM, kClusterM);
  const GuideCones cones = guide.at(kFrom, kUp);
  ASSERT_GT(cones.share, 0.1f);
  Rng rng(4, 5, 6);
  int there = 0;
  for (int i = 0; i < 1000; ++i) {
    const Vec3 d = cones.sample(rng.uniform2(), rng.uniform());
    there += length(kFrom + d * (2 / std::max(d.y, 1e-3f)) - kBright) < 0.5f;
  }
  EXPECT_GT(there, 700);
}

TEST(HitGuide, densityIsThatOfItsSamples) {
  const HitGuide guide(raysToCeiling(4000), kRegionM, kClusterM);
  const GuideCones cones = guide.at(kFrom, kUp);
  ASSERT_GT(cones.count, 0);
  double whole = 0, inverse = 0, covered = 0;
  int outside = 0;
  Rng rng(7, 8, 9);
  constexpr int kCount = 4'000'000;
  for (int i = 0; i < kCount; ++i) {
    const Vec3 even = sampleSphere(rng.uniform2());
    const float pdf = cones.pdf(even);
    whole += 4 * static_cast<double>(kPi) * static_cast<double>(pdf) / kCount,
        covered += pdf > 0 ? 4 * static_cast<double>(kPi) / kCount : 0;
    const float own = cones.pdf(cones.sample(rng.uniform2(), rng.uniform()));
    inverse += own > 0 ? 1 / static_cast<double>(own) / kCount : 0;
    outside += own > 0 ? 0 : 1;
  }
  EXPECT_LT(outside, kCount / 100'000);  // by rounding, on the very edge of a cone
  EXPECT_NEAR(whole, 1, 0.03);  // integrates to 1,
  EXPECT_NEAR(inverse / covered, 1, 0.03);  // and its samples are spread by it
}

TEST(HitGuide, leavesEvenLightToChance) {
  std::vector<GuideRay> rays = raysToCeiling(4000);
  for (GuideRay& r : rays) r.light = 1;
  EXPECT_EQ(HitGuide(rays, kRegionM, kClusterM).at(kFrom, kUp).share, 0);
}

TEST(HitGuide, knowsNothingOfRegionsWithoutRays) {
  const HitGuide guide(raysToCeiling(4000), kRegionM, kClusterM);
  EXPECT_EQ(guide.at({10, 0, 10}, kUp).share, 0);
  EXPECT_EQ(guide.at(kFrom, {0, -1, 0}).share, 0);
}

}  // namespace
}  // namespace roomlight
