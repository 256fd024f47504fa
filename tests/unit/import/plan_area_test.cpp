// What the work on areas is said to come to, before it is done.
#include "import/plan_area.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "import/sh3d_effort.h"

namespace roomlight::importers {
namespace {

constexpr size_t kAny = size_t{1} << 40;

// Every `step`th of `n` points on a circle is the next corner.
PlanRing star(size_t n, size_t step) {
  PlanRing ring;
  for (size_t i = 0; i < n; ++i) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(i * step % n) / static_cast<double>(n);
    ring.push_back({100 + 90 * std::cos(angle), 100 + 90 * std::sin(angle)});
  }
  return ring;
}

// Teeth that point along x, or along y.
PlanRing comb(int teeth, bool along) {
  PlanRing ring{{-1, 0}};
  for (int i = 0; i < teeth; ++i) {
    const double at = i, tip = teeth + 0.001 * i;
    for (const PlanPoint p : {PlanPoint{0, at}, {tip, at}, {tip, at + 0.5}, {0, at + 0.5}}) ring.push_back(p);
  }
  ring.push_back({-1, static_cast<double>(teeth)});
  if (!along) {
    for (PlanPoint& p : ring) std::swap(p.x, p.y);
  }
  return ring;
}

TEST(PlanWork, trianglesAreCountedBefore) {
  for (const PlanArea& area : {united({star(40, 1)}, {}), PlanArea{comb(30, true)}, PlanArea{comb(30, false)},
                               subtracted({star(40, 1)}, {{{80, 80}, {120, 80}, {120, 120}, {80, 120}}})}) {
    const size_t made = trianglesOf(area).size();
    EXPECT_GE(mostTrianglesOf(area), made);
    EXPECT_LE(mostTrianglesOf(area), made + made / 2 + 4);
  }
  // Few corners can make many triangles.
  EXPECT_GT(mostTrianglesOf({comb(500, true)}), 200'000u);
}

TEST(PlanWork, crossingsAreCounted) {
  EXPECT_EQ(tangleOf({star(5, 1)}, kAny).crossings, 0u);
  EXPECT_EQ(tangleOf({star(5, 2)}, kAny).crossings, 5u);
  EXPECT_EQ(tangleOf({star(101, 50)}, kAny).crossings, 101u * 49);
  EXPECT_EQ(tangleOf({comb(100, true)}, kAny).crossings, 0u);
}

TEST(PlanWork, countingEndsWhereThereIsTooMuch) {
  EXPECT_LE(tangleOf({star(2000, 999)}, 1000).crossings, 1001u);
  sh3d::Effort effort;
  EXPECT_FALSE(effort.untangles({star(2000, 999)}, "room"));
  EXPECT_LT(effort.used(), 10'000u);
  EXPECT_TRUE(effort.untangles({star(2000, 1)}, "room"));
  EXPECT_TRUE(effort.untangles({star(5, 2)}, "room"));
}

TEST(PlanWork, crossingsOfTwoAreasAreWork) {
  const PlanArea a{comb(200, true)}, b{comb(200, false)};
  const size_t alone = combiningSteps(a, {}, kAny), both = combiningSteps(a, b, kAny);
  EXPECT_LT(alone, 100'000u);
  EXPECT_GT(both, 200u * 200 * 4 * 8);  // each side of a tooth crosses each of the others
  EXPECT_LT(combiningSteps(a, b, 150'000), 300'000u);
  sh3d::Effort effort;
  EXPECT_THROW(for (int i = 0; i < 1000; ++i) effort.spendOn(a, b, "room"), Failure);
}

TEST(PlanWork, trianglesAndCopiesHaveALimit) {
  sh3d::Effort effort(100);
  effort.make(60, "wall 'a'");
  effort.ask(40, "wall 'b'");
  try {
    effort.ask(30, "wall 'b'", 20);
    ADD_FAILURE();
  } catch (const Failure& failure) {
    EXPECT_STREQ(failure.what(),
                 "wall 'b': would make 30 triangles, 110 with all before it; a home of more than 100 is too fine");
  }
  EXPECT_THROW(effort.make(41, "wall 'b'"), Failure);
  EXPECT_THROW(sh3d::Effort().ask(sh3d::Effort::kMostTriangles + 1, ""), Failure);
  sh3d::Effort copies;
  copies.copy(100'000'000, "chair");
  EXPECT_THROW(copies.copy(100'000'000, "chair"), Failure);
}

}  // namespace
}  // namespace roomlight::importers
