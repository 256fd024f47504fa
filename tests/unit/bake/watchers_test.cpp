#include "bake/watchers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace roomlight::bake {
namespace {

std::vector<Watchers::Sighting> sightingsOf(Vec3 p, uint32_t eyes) {
  std::vector<Watchers::Sighting> out;
  for (uint32_t eye = eyes; eye-- > 0;) out.insert(out.end(), 2, {Watchers::cellOf(p), eye});
  return out;
}

TEST(Watchers, fewAreAllKept) {
  const Watchers watchers(sightingsOf({0.5f, 0.5f, 0.5f}, 24));
  const auto eyes = watchers.of({0.9f, 0.1f, 0.3f});
  ASSERT_EQ(eyes.size(), 24u);
  for (uint32_t i = 0; i < 24; ++i) EXPECT_EQ(eyes[i], i);
}

TEST(Watchers, ofManyTheFirstAndOthersFromAll) {
  const Watchers watchers(sightingsOf({-0.5f, 0.5f, 0.5f}, 1000));
  const auto eyes = watchers.of({-0.1f, 0.1f, 0.3f});
  ASSERT_EQ(eyes.size(), 24u);
  for (uint32_t i = 0; i < 4; ++i) EXPECT_EQ(eyes[i], i);
  EXPECT_GT(*std::max_element(eyes.begin(), eyes.end()), 900u);
  EXPECT_EQ(std::set<uint32_t>(eyes.begin(), eyes.end()).size(), 24u);
}

TEST(Watchers, cellsAreApart) {
  const Watchers watchers(sightingsOf({0.5f, 0.5f, 0.5f}, 3));
  for (const Vec3 p : {Vec3{-0.5f, 0.5f, 0.5f}, Vec3{0.5f, 1.5f, 0.5f}, Vec3{0.5f, 0.5f, 2.5f}, Vec3{0.5f, 0.5f, 1e9f}})
    EXPECT_TRUE(watchers.of(p).empty());
}

}  // namespace
}  // namespace roomlight::bake
