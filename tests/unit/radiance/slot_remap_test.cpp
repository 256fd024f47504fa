// What a change may have to do with is found whole: nothing that crosses it is overlooked.
#include "radiance/slot_remap.h"

#include <gtest/gtest.h>

#include "base/sampler.h"
#include "base/sampling.h"
#include "radiance/direct_light.h"
#include "radiance/sky_guide.h"

namespace roomlight {
namespace {

Bounds3 boxAt(Sampler& sampler, float size) {
  const auto next3 = [&] { return Vec3{sampler.next1(), sampler.next1(), sampler.next1()}; };
  const Vec3 lo = next3() * 4;
  return {lo, lo + next3() * size};
}

Vec3 within(const Bounds3& box, Sampler& sampler) {
  return box.lo + box.size() * Vec3{sampler.next1(), sampler.next1(), sampler.next1()};
}

TEST(MayMeetBetween, holdsForEverySegmentThatMeetsABox) {
  int met = 0, spared = 0;
  for (uint32_t i = 0; i < 10000; ++i) {
    Sampler sampler(1, i, 0);
    const Bounds3 from = boxAt(sampler, 0.6f), to = boxAt(sampler, 0.6f), box = boxAt(sampler, 0.5f);
    const bool may = mayMeetBetween(from, to, std::span(&box, 1));
    spared += may ? 0 : 1;
    for (int k = 0; k < 20; ++k) {
      const Vec3 a = within(from, sampler), b = within(to, sampler);
      if (!crosses({a, normalize(b - a), 0, length(b - a)}, std::span(&box, 1), 0)) continue;
      ASSERT_TRUE(may) << i;
      ++met;
    }
  }
  EXPECT_GT(met, 500);
  EXPECT_GT(spared, 5000);
}

// The hull of two equal boxes one behind the other is a corridor: what stands beside it is never met.
TEST(MayMeetBetween, sparesWhatStandsBesideTheWay) {
  const Bounds3 from{{0, 0, 0}, {1, 1, 1}}, to{{4, 4, 0}, {5, 5, 1}};
  const Bounds3 corner{{0, 3.2f, 0}, {1.8f, 5, 1}}, middle{{2, 2, 0}, {2.1f, 2.1f, 1}},
      behind{{5.1f, 5.1f, 0}, {6, 6, 1}};
  EXPECT_FALSE(mayMeetBetween(from, to, std::span(&corner, 1)));
  EXPECT_TRUE(mayMeetBetween(from, to, std::span(&middle, 1)));
  EXPECT_FALSE(mayMeetBetween(from, to, std::span(&behind, 1)));
}

TEST(SkyDirection, keepsADirectionToWhatItSays) {
  for (uint32_t i = 0; i < 20000; ++i) {
    const Vec3 d = sampleSphere(Sampler(2, i, 0).next2());
    ASSERT_LT(length(SkyDirection(d).direction() - d), SkyDirection::kOff) << i;
  }
  EXPECT_TRUE(isBlack(SkyDirection().direction()));
  for (const Vec3 axis : {Vec3{1, 0, 0}, Vec3{0, -1, 0}, Vec3{0, 0, 1}})
    EXPECT_LT(length(SkyDirection(axis).direction() - axis), SkyDirection::kOff);
}

}  // namespace
}  // namespace roomlight
