#include "search/search.h"

#include <gtest/gtest.h>

#include <atomic>
#include <set>

#include "base/parallel.h"
#include "search/generation.h"
#include "search/test_problems.h"

namespace roomlight::search {
namespace {

struct Counted {
  Problem problem;
  std::shared_ptr<std::atomic<size_t>> evaluated = std::make_shared<std::atomic<size_t>>(0),
                                       polishes = std::make_shared<std::atomic<size_t>>(0);
};

// A problem that counts what is asked of it, and fails where a design was not repaired.
Counted counted(const Problem& plain) {
  Counted c{plain};
  c.problem.evaluate = [plain, n = c.evaluated](const Genomes& designs, std::span<double> out) {
    *n += designs.count;
    EXPECT_EQ(out.size(), designs.count * plain.objectives);
    EXPECT_TRUE(fits(plain, designs));
    if (plain.repair) {
      Genomes again = designs;
      for (size_t i = 0; i < again.count; ++i) plain.repair(again[i]);
      EXPECT_EQ(again.integers, designs.integers);
      EXPECT_EQ(again.reals, designs.reals);
    }
    plain.evaluate(designs, out);
  };
  if (plain.polish)
    c.problem.polish = [plain, n = c.polishes](Genome d, const Wish& wish) {
      ++*n;
      return plain.polish(d, wish);
    };
  return c;
}

class EveryMethod : public ::testing::TestWithParam<Method> {};

TEST_P(EveryMethod, countsEveryEvaluationAndStopsAtTheBudget) {
  const Counted c = counted(lampRow().problem);
  State state = start(c.problem, {.method = GetParam(), .evaluations = 3000});
  run(c.problem, state);
  // Each polish of this problem counts three besides the evaluation of its outcome.
  EXPECT_EQ(state.evaluations, *c.evaluated + 3 * *c.polishes);
  EXPECT_EQ(state.polished, *c.polishes);
  EXPECT_EQ(state.polished > 0, GetParam() == Method::hybrid);
  EXPECT_EQ(state.polishEvaluations, 4 * state.polished);
  EXPECT_GE(state.evaluations, 3000u);
  EXPECT_LT(state.evaluations, 3500u);
}

TEST_P(EveryMethod, givesTheSameFrontWithAnyNumberOfThreads) {
  const Problem problem = lampRow().problem;
  std::vector<State> states;
  for (int threads : {1, 2})
    withThreads(threads, [&] {
      states.push_back(start(problem, {.method = GetParam(), .seed = 5, .evaluations = 2000}));
      run(problem, states.back());
    });
  EXPECT_EQ(states[1].archive.objectives, states[0].archive.objectives);
  EXPECT_EQ(states[1].archive.designs.reals, states[0].archive.designs.reals);
  EXPECT_EQ(states[1].population.integers, states[0].population.integers);
  State other = start(problem, {.method = GetParam(), .seed = 6, .evaluations = 2000});
  run(problem, other);
  EXPECT_NE(other.archive.objectives, states[0].archive.objectives);
}

TEST_P(EveryMethod, keepsTheObjectivesOfItsDesigns) {
  const Problem problem = lampRow().problem;
  State state = start(problem, {.method = GetParam(), .evaluations = 2000});
  run(problem, state);
  for (const auto& [designs, objectives] :
       {std::pair{state.population, state.objectives}, {state.archive.designs, state.archive.objectives}}) {
    std::vector<double> again(objectives.size());
    problem.evaluate(designs, again);
    EXPECT_EQ(again, objectives);
  }
}

INSTANTIATE_TEST_SUITE_P(Table, EveryMethod,
                         ::testing::Values(Method::hybrid, Method::nsga2, Method::pagmoNsga2, Method::weightedSum,
                                           Method::random),
                         [](const auto& row) { return std::string(nameOf(row.param)); });

TEST(Search, startsFromGivenDesigns) {
  const TestProblem test = mixedZdt1();
  Genomes good = test.problem.none();
  good.resize(1);
  test.problem.polish(good[0], Wish{std::vector<double>{0.1, 1}, std::vector<double>{1, 1}});
  State state = start(test.problem, {.method = Method::nsga2}, good);
  EXPECT_EQ(state.population[0].reals[1], good.reals[1]);
}

TEST(Search, stopsWhenToldAndReportsProgress) {
  const Problem problem = zdt1().problem;
  State state = start(problem, {.evaluations = 100'000});
  std::atomic<bool> cancelled = false;
  std::vector<float> fractions;
  int generations = 0;
  run(problem, state, {[&](float f) { fractions.push_back(f); }, &cancelled}, [&](const State& s) {
    EXPECT_EQ(&s, &state);
    cancelled = ++generations == 7;
  });
  EXPECT_EQ(generations, 7);
  EXPECT_EQ(state.generation, 8u);
  EXPECT_EQ(state.evaluations, 800u);
  ASSERT_EQ(fractions.size(), 7u);
  EXPECT_FLOAT_EQ(fractions.back(), 0.008f);
  EXPECT_FALSE(finished(state));
  EXPECT_GT(secondsLeft(state), state.seconds);
}

TEST(Search, endsByTheClock) {
  const Problem problem = zdt1().problem;
  State state = start(problem, {.evaluations = 1'000'000'000, .seconds = 0.05});
  run(problem, state);
  EXPECT_GE(state.seconds, 0.05);
  EXPECT_LT(state.evaluations, 1'000'000'000u);
}

TEST(Search, hybridWithoutPolishIsNsga2) {
  Problem problem = lampRow().problem;
  problem.polish = nullptr;
  State hybrid = start(problem, {.method = Method::hybrid, .evaluations = 1000}),
        plain = start(problem, {.method = Method::nsga2, .evaluations = 1000});
  run(problem, hybrid), run(problem, plain);
  EXPECT_EQ(hybrid.archive.objectives, plain.archive.objectives);
}

TEST(Search, spendsNothingWhereThereIsNothingToPolish) {
  Counted c = counted(lampRow().problem);
  c.problem.polish = [](Genome, const Wish&) { return size_t{0}; };
  State state = start(c.problem, {.method = Method::hybrid, .evaluations = 1000});
  run(c.problem, state);
  EXPECT_EQ(state.polished, 0u);
  EXPECT_EQ(state.polishEvaluations, 0u);
  EXPECT_EQ(state.evaluations, *c.evaluated);
}

TEST(Search, drawsChanceFromTheProblemInEveryGeneration) {
  Problem problem = zdt1().problem;
  std::vector<size_t> generations;
  problem.draw = [&, none = problem.none()](size_t count, uint64_t seed, size_t generation) {
    EXPECT_EQ(seed, 9u);
    generations.push_back(generation);
    Genomes designs = none;
    designs.resize(count);
    return designs;
  };
  State state = start(problem, {.method = Method::random, .seed = 9, .evaluations = 300});
  run(problem, state);
  EXPECT_EQ(generations, (std::vector<size_t>{0, 1, 2}));
}

TEST(Search, weightingsFillTheSimplex) {
  EXPECT_EQ(weightings(2, 10).size(), 10u);
  EXPECT_EQ(weightings(3, 10).size(), 10u);
  EXPECT_EQ(weightings(4, 10).size(), 10u);
  std::set<std::vector<double>> all;
  for (const auto& w : weightings(3, 10)) {
    EXPECT_NEAR(w[0] + w[1] + w[2], 1, 1e-12);
    all.insert(w);
  }
  EXPECT_EQ(all.size(), 10u);
  EXPECT_TRUE(all.contains({1, 0, 0}));
}

TEST(Settings, outOfRangeAreRefused) {
  const Problem problem = zdt1().problem;
  EXPECT_TRUE(check(problem, {}));
  EXPECT_EQ(check(problem, {.population = 50}).error(), "population: give a multiple of 4, at least 8");
  EXPECT_FALSE(check(problem, {.polishShare = 1}));
  Problem empty = problem;
  empty.integers.push_back({.cardinality = 0});
  EXPECT_EQ(check(empty, {}).error(), "integers[0]: has no value to take; give it one or leave it out");
  empty = problem;
  empty.objectives = 5;
  EXPECT_EQ(check(empty, {}).error(), "objectives: give two to four");
}

TEST(Methods, areFoundByName) {
  for (const MethodInfo& row : methodTable()) EXPECT_EQ(methodNamed(row.name).value(), row.method);
  EXPECT_EQ(methodNamed("sga").error(), "method: unknown \"sga\"; use one of hybrid, nsga2, pagmo, weighted, random");
}

}  // namespace
}  // namespace roomlight::search
