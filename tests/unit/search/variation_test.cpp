#include "search/variation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "search/test_problems.h"

namespace roomlight::search {
namespace {

Problem shaped(std::vector<IntegerVariable> integers, std::vector<RealVariable> reals) {
  Problem problem;
  problem.integers = std::move(integers);
  problem.reals = std::move(reals);
  return problem;
}

TEST(Mutation, reachesEveryValueAndNoOther) {
  const Problem problem = shaped({{.cardinality = 5}, {.cardinality = 7, .ordered = true}, {.cardinality = 1}}, {{}});
  std::set<int32_t> seen[2];
  for (size_t i = 0; i < 500; ++i) {
    Genomes one = problem.none();
    one.append(ConstGenome{std::vector<int32_t>{2, 3, 0}, std::vector<double>{0.5}});
    Draws draws(1, 0, Purpose::vary, i);
    mutate(problem, {.mutationRate = 1}, one[0], draws);
    ASSERT_TRUE(fits(problem, one));
    EXPECT_NE(one.integers[0], 2);
    EXPECT_NE(one.integers[1], 3);
    EXPECT_NE(one.reals[0], 0.5);
    seen[0].insert(one.integers[0]), seen[1].insert(one.integers[1]);
  }
  EXPECT_EQ(seen[0].size(), 4u);
  EXPECT_EQ(seen[1].size(), 6u);
}

TEST(Mutation, ofOrderedIntegersPrefersNeighbours) {
  const Problem problem = shaped({{.cardinality = 41, .ordered = true}, {.cardinality = 41}}, {});
  int near[2] = {0, 0};
  for (size_t i = 0; i < 1000; ++i) {
    Genomes one = problem.none();
    one.append(ConstGenome{std::vector<int32_t>{20, 20}, {}});
    Draws draws(1, 0, Purpose::vary, i);
    mutate(problem, {.mutationRate = 1}, one[0], draws);
    for (size_t k : {0, 1}) near[k] += std::abs(one.integers[k] - 20) == 1;
  }
  EXPECT_GT(near[0], 230);  // a quarter and 2 in 40 of the rest: 275 expected
  EXPECT_LT(near[1], 90);   // 50 expected
}

TEST(Mutation, happensAtItsRate) {
  const Problem problem = shaped({}, std::vector<RealVariable>(50));
  size_t changed = 0;
  for (size_t i = 0; i < 400; ++i) {
    Genomes one = problem.none();
    one.append(ConstGenome{{}, std::vector<double>(50, 0.5)});
    Draws draws(3, 0, Purpose::vary, i);
    mutate(problem, {}, one[0], draws);
    for (double x : one.reals) changed += x != 0.5;
  }
  EXPECT_NEAR(static_cast<double>(changed) / 400, 1, 0.15);  // one over their number; three standard deviations
}

// Simulated binary crossover keeps the mean of the parents in the middle of the range, and the spread of its density is
// symmetric.
TEST(Crossover, ofRealsKeepsTheMeanAndStaysInside) {
  const Problem problem = shaped({}, {{}});
  double sum = 0;
  int beyond = 0, crossed = 0;
  constexpr int kCount = 4000;
  for (size_t i = 0; i < kCount; ++i) {
    Genomes two = problem.none();
    two.append(ConstGenome{{}, std::vector<double>{0.4}}), two.append(ConstGenome{{}, std::vector<double>{0.6}});
    Draws draws(1, 0, Purpose::vary, i);
    cross(problem, {.crossoverRate = 1, .crossoverIndex = 2}, two[0], two[1], draws);
    ASSERT_TRUE(fits(problem, two));
    EXPECT_NEAR(two.reals[0] + two.reals[1], 1, 1e-12);
    const double spread = std::abs(two.reals[0] - two.reals[1]);
    if (std::abs(spread - 0.2) > 1e-12) ++crossed, beyond += spread > 0.2, sum += two.reals[0];
  }
  EXPECT_NEAR(crossed, kCount / 2, 100);
  EXPECT_NEAR(static_cast<double>(beyond) / crossed, 0.5, 0.04);
  EXPECT_NEAR(sum / crossed, 0.5, 0.01);
}

TEST(Crossover, inheritsGroupsWhole) {
  const Problem problem = shaped({{.cardinality = 9, .group = 0},
                                  {.cardinality = 9, .group = 0},
                                  {.cardinality = 9, .group = 1},
                                  {.cardinality = 9}},
                                 {});
  std::set<std::vector<int32_t>> seen;
  for (size_t i = 0; i < 200; ++i) {
    Genomes two = problem.none();
    two.append(ConstGenome{std::vector<int32_t>{1, 1, 1, 1}, {}}),
        two.append(ConstGenome{std::vector<int32_t>{2, 2, 2, 2}, {}});
    Draws draws(1, 0, Purpose::vary, i);
    cross(problem, {.crossoverRate = 1}, two[0], two[1], draws);
    EXPECT_EQ(two.integers[0], two.integers[1]);
    for (size_t k = 0; k < 4; ++k) EXPECT_EQ(two.integers[k] + two.integers[4 + k], 3);
    seen.insert({two.integers.begin(), two.integers.begin() + 4});
  }
  EXPECT_EQ(seen.size(), 8u);
}

// Two blocks of two groups, each of a kind and a real; a variable that belongs to none.
Problem inBlocks() {
  Problem problem;
  for (int32_t g = 0; g < 4; ++g)
    problem.integers.push_back({.cardinality = 9, .group = g}), problem.reals.push_back({.group = g});
  problem.integers.push_back({.cardinality = 9});
  problem.blockOfGroup = {0, 0, 1, 1};
  return problem;
}

TEST(Blocks, areExchangedWhole) {
  const Problem problem = inBlocks();
  const Blocks blocks(problem);
  std::set<std::vector<int32_t>> seen;
  for (size_t i = 0; i < 100; ++i) {
    Genomes two = problem.none();
    two.append(ConstGenome{std::vector<int32_t>(5, 1), std::vector<double>(4, 0.1)}),
        two.append(ConstGenome{std::vector<int32_t>(5, 2), std::vector<double>(4, 0.2)});
    Draws draws(1, 0, Purpose::vary, i);
    blocks.exchange(two[0], two[1], draws);
    for (size_t k = 0; k < 5; ++k) EXPECT_EQ(two.integers[k] + two.integers[5 + k], 3);
    for (size_t k = 0; k < 4; ++k) EXPECT_EQ(two.reals[k], 0.1 * two.integers[k]);
    for (const size_t k : {0, 2}) EXPECT_EQ(two.integers[k], two.integers[k + 1]);
    EXPECT_EQ(two.integers[4], 1);
    seen.insert({two.integers.begin(), two.integers.begin() + 5});
  }
  EXPECT_EQ(seen.size(), 4u);
}

TEST(Blocks, moveWhatAGroupHoldsWithinThem) {
  const Problem problem = inBlocks();
  const Blocks blocks(problem);
  std::set<std::vector<int32_t>> seen;
  for (size_t i = 0; i < 100; ++i) {
    Genomes one = problem.none();
    one.append(ConstGenome{std::vector<int32_t>{0, 3, 5, 7, 8}, std::vector<double>{0, 0.3, 0.5, 0.7}});
    Draws draws(1, 0, Purpose::vary, i);
    blocks.move(one[0], draws);
    for (size_t k = 0; k < 4; ++k) EXPECT_NEAR(one.reals[k], 0.1 * one.integers[k], 1e-12);
    seen.insert(one.integers);
  }
  seen.erase({0, 3, 5, 7, 8});  // chance may have found none
  EXPECT_EQ(seen, (std::set<std::vector<int32_t>>{{3, 0, 5, 7, 8}, {0, 3, 7, 5, 8}}));
}

TEST(Blocks, ofAProblemMustHoldEveryGroup) {
  Problem problem = inBlocks();
  problem.evaluate = [](const Genomes&, std::span<double>) {};
  EXPECT_TRUE(check(problem));
  problem.blockOfGroup.pop_back();
  EXPECT_FALSE(check(problem));
  problem.blockOfGroup.clear();
  EXPECT_TRUE(check(problem));
  EXPECT_FALSE(Blocks(problem).any());
}

TEST(Offspring, areRepairedAndNew) {
  const Problem problem = lampRow().problem;
  Genomes parents = problem.none();
  parents.resize(40);
  for (size_t i = 0; i < 40; ++i) problem.repair(parents[i]);  // all the same
  const Genomes children = offspring(problem, {}, 3, parents, parents);
  ASSERT_TRUE(fits(problem, children));
  std::set<std::pair<std::vector<int32_t>, std::vector<double>>> seen;
  for (size_t i = 0; i < children.count; ++i) {
    Genomes again = children;
    problem.repair(again[i]);
    EXPECT_EQ(again.integers, children.integers);
    seen.insert({{children[i].integers.begin(), children[i].integers.end()},
                 {children[i].reals.begin(), children[i].reals.end()}});
  }
  seen.insert(
      {{parents[0].integers.begin(), parents[0].integers.end()}, {parents[0].reals.begin(), parents[0].reals.end()}});
  EXPECT_EQ(seen.size(), 41u);
}

}  // namespace
}  // namespace roomlight::search
