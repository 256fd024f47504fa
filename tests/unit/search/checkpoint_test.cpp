#include "search/search.h"

#include <gtest/gtest.h>

#include "search/test_problems.h"

namespace roomlight::search {
namespace {

void expectEqual(const State& a, const State& b) {
  EXPECT_EQ(a.generation, b.generation);
  EXPECT_EQ(a.evaluations, b.evaluations);
  EXPECT_EQ(a.polished, b.polished);
  EXPECT_EQ(a.polishEvaluations, b.polishEvaluations);
  EXPECT_EQ(a.population.integers, b.population.integers);
  EXPECT_EQ(a.population.reals, b.population.reals);
  EXPECT_EQ(a.objectives, b.objectives);
  EXPECT_EQ(a.archive.limit, b.archive.limit);
  EXPECT_EQ(a.archive.designs.integers, b.archive.designs.integers);
  EXPECT_EQ(a.archive.designs.reals, b.archive.designs.reals);
  EXPECT_EQ(a.archive.objectives, b.archive.objectives);
}

class Checkpoints : public ::testing::TestWithParam<Method> {};

TEST_P(Checkpoints, goOnAsIfNeverStopped) {
  const Problem problem = lampRow().problem;
  const Settings settings{.method = GetParam(), .seed = 0xfedcba9876543210ull, .evaluations = 4000, .archive = 60};
  State through = start(problem, settings);
  run(problem, through);
  State stopped = start(problem, settings);
  while (stopped.evaluations < 1500) advance(problem, stopped);
  Result<State> read = stateFromJson(toJson(stopped), problem, "checkpoint");
  ASSERT_TRUE(read) << read.error();
  State resumed = std::move(read).value();
  EXPECT_EQ(resumed.seconds, stopped.seconds);
  EXPECT_EQ(resumed.settings.seed, settings.seed);
  expectEqual(resumed, stopped);
  run(problem, resumed);
  expectEqual(resumed, through);
}

INSTANTIATE_TEST_SUITE_P(Table, Checkpoints,
                         ::testing::Values(Method::hybrid, Method::nsga2, Method::pagmoNsga2, Method::weightedSum,
                                           Method::random),
                         [](const auto& row) { return std::string(nameOf(row.param)); });

TEST(Checkpoint, ofAnotherProblemIsRefused) {
  const State state = start(lampRow().problem, {});
  const auto other = stateFromJson(toJson(state), mixedZdt1().problem, "old.json");
  ASSERT_FALSE(other);
  EXPECT_EQ(other.error(),
            "old.json: population: designs of another problem; go on with the study the checkpoint was made from");
}

TEST(Checkpoint, thatIsDamagedIsRefused) {
  const Problem problem = lampRow().problem;
  const std::string text = toJson(start(problem, {}));
  EXPECT_FALSE(stateFromJson("", problem, "x"));
  EXPECT_FALSE(stateFromJson("[]", problem, "x"));
  EXPECT_FALSE(stateFromJson(text.substr(0, text.size() / 2), problem, "x"));
  using Change = std::pair<std::string, std::string>;
  for (const auto& [from, to] : {Change{"\"version\":1", "\"version\":2"},
                                 {"\"hybrid\"", "\"other\""},
                                 {"\"population\":100", "\"population\":7"},
                                 {"\"generation\"", "\"gen\""}}) {
    std::string damaged = text;
    const size_t at = damaged.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    damaged.replace(at, from.size(), to);
    const auto state = stateFromJson(damaged, problem, "x");
    EXPECT_FALSE(state) << from;
    EXPECT_EQ(state.error().substr(0, 3), "x: ") << from;
  }
}

}  // namespace
}  // namespace roomlight::search
