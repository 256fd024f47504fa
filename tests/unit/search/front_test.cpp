// The hypervolumes that are asked of the searches: 20,000 evaluations, reference point 1.1. docs/measured/search.md has
// ten seeds.
#include <gtest/gtest.h>

#include "search/front.h"
#include "search/search.h"
#include "search/test_problems.h"

namespace roomlight::search {
namespace {

double volumeAfter(const TestProblem& test, Method method, size_t evaluations, uint64_t seed = 1) {
  State state = start(test.problem, {.method = method, .seed = seed, .evaluations = evaluations});
  run(test.problem, state);
  EXPECT_TRUE(fits(test.problem, state.archive.designs));
  return hypervolume(state.archive.objectives, test.reference);
}

class Fronts : public ::testing::TestWithParam<TestProblem (*)()> {};

TEST_P(Fronts, ofNsga2ReachTheHypervolumeAsked) {
  const TestProblem test = GetParam()();
  ASSERT_GT(test.askedHypervolume, 0);
  for (const Method method : {Method::nsga2, Method::pagmoNsga2}) {
    const double volume = volumeAfter(test, method, 20'000);
    EXPECT_GE(volume, test.askedHypervolume) << nameOf(method);
    EXPECT_LE(volume, test.bestHypervolume + 1e-4) << nameOf(method);  // or it is not what it says
  }
}

INSTANTIATE_TEST_SUITE_P(Asked, Fronts, ::testing::Values(zdt1, zdt2, dtlz2),
                         [](const auto& row) { return row.param().name; });

TEST(Fronts, ofTheMixedProblemAreFoundByTheHybrid) {
  const TestProblem test = mixedZdt1();
  const double hybrid = volumeAfter(test, Method::hybrid, 20'000), plain = volumeAfter(test, Method::nsga2, 20'000);
  EXPECT_GE(hybrid, 0.875);
  EXPECT_LE(hybrid, test.bestHypervolume + 1e-4);
  EXPECT_GE(plain, 0.870);
}

TEST(Fronts, ofTheHybridNeedFewerEvaluations) {
  for (const TestProblem& test : {mixedZdt1(), lampRow()})
    EXPECT_GT(volumeAfter(test, Method::hybrid, 10'000), volumeAfter(test, Method::nsga2, 20'000)) << test.name;
}

TEST(Fronts, ofRandomDesignsAndWeightedSumsAreWorse) {
  const TestProblem test = lampRow();
  const double random = volumeAfter(test, Method::random, 10'000),
               weighted = volumeAfter(test, Method::weightedSum, 10'000);
  EXPECT_GT(weighted, random);
  EXPECT_GT(volumeAfter(test, Method::nsga2, 10'000), weighted);
}

}  // namespace
}  // namespace roomlight::search
