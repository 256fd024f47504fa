#include "search/dimming.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"

namespace roomlight::search {
namespace {

DenseMatrix randomMatrix(size_t rows, size_t columns, uint64_t seed) {
  Rng rng(rows, columns, seed);
  DenseMatrix a{rows, columns, std::vector<double>(rows * columns)};
  for (double& v : a.values) v = static_cast<double>(rng.uniform());
  return a;
}

double received(const DenseMatrix& a, size_t row, const std::vector<double>& x) {
  double sum = 0;
  for (size_t c = 0; c < a.columns; ++c) sum += a.row(row)[c] * x[c];
  return sum;
}

// Every point gets at least 60 % of what the darkest gets at full power, none more than 95 % of the brightest.
LinearProgram randomProgram(size_t rows, size_t columns, uint64_t seed) {
  LinearProgram p;
  p.a = randomMatrix(rows, columns, seed);
  double least = kUnbounded, most = 0;
  for (size_t r = 0; r < rows; ++r) {
    const double full = received(p.a, r, std::vector<double>(columns, 1.0));
    least = std::min(least, full), most = std::max(most, full);
  }
  p.atLeast.assign(rows, 0.6 * least);
  p.atMost.assign(rows, 0.95 * most);
  Rng rng(1, 2, seed);
  for (size_t c = 0; c < columns; ++c) p.cost.push_back(0.2 + static_cast<double>(rng.uniform()));
  return p;
}

TEST(LinearProgram, ofTwoLampsByHand) {
  // Lamp 0 gives 2 and 1, lamp 1 gives 1 and 2; both points want 1.5; watts 1 and 3. Cheapest: x0 = 1, then point 1
// needs x1 = 0.25.
  LinearProgram p;
  p.a = {2, 2, {2, 1, 1, 2}};
  p.atLeast = {1.5, 1.5};
  p.cost = {1, 3};
  const auto solution = minimise(p);
  ASSERT_TRUE(solution) << solution.error();
  EXPECT_NEAR(solution.value().x[0], 1, 1e-9);
  EXPECT_NEAR(solution.value().x[1], 0.25, 1e-9);
  EXPECT_NEAR(solution.value().cost, 1.75, 1e-9);
  EXPECT_NEAR(solution.value().price[0], 0, 1e-9);
  EXPECT_NEAR(solution.value().price[1], 1.5, 1e-9);
}

// Feasible, and dual feasible with the same cost: no other point can be cheaper.
TEST(LinearProgram, isCertifiedByItsPrices) {
  for (const auto& [rows, columns] : {std::pair<size_t, size_t>{10, 4}, {100, 20}, {400, 60}}) {
    const LinearProgram p = randomProgram(rows, columns, rows);
    const auto solution = minimise(p);
    ASSERT_TRUE(solution) << solution.error();
    const auto& [x, price, cost] = solution.value();
    double dual = 0;
    for (size_t r = 0; r < rows; ++r) {
      const double lux = received(p.a, r, x);
      EXPECT_GE(lux, p.atLeast[r] - 1e-6);
      EXPECT_LE(lux, p.atMost[r] + 1e-6);
      dual += price[r] * (price[r] > 0 ? p.atLeast[r] : p.atMost[r]);
    }
    for (size_t c = 0; c < columns; ++c) {
      EXPECT_GE(x[c], 0);
      EXPECT_LE(x[c], 1);
      double reduced = p.cost[c];
      for (size_t r = 0; r < rows; ++r) reduced -= price[r] * p.a.row(r)[c];
      dual += std::min(0.0, reduced);  // the bound x <= 1 is worth this
    }
    EXPECT_NEAR(dual, cost, 1e-6 * cost);
  }
}

TEST(LinearProgram, agreesWithTryingEveryDimming) {
  const LinearProgram p = randomProgram(12, 3, 5);
  const auto solution = minimise(p);
  ASSERT_TRUE(solution) << solution.error();
  constexpr int kSteps = 100;
  double best = kUnbounded;
  for (int i = 0; i <= kSteps; ++i)
    for (int j = 0; j <= kSteps; ++j)
      for (int k = 0; k <= kSteps; ++k) {
        const std::vector<double> x{i / double{kSteps}, j / double{kSteps}, k / double{kSteps}};
        bool good = true;
        for (size_t r = 0; r < p.a.rows && good; ++r)
          good = received(p.a, r, x) >= p.atLeast[r] && received(p.a, r, x) <= p.atMost[r];
        if (good) best = std::min(best, p.cost[0] * x[0] + p.cost[1] * x[1] + p.cost[2] * x[2]);
      }
  EXPECT_LE(solution.value().cost, best + 1e-9);
  EXPECT_GE(solution.value().cost, best - 3.6 / kSteps);  // a step of every lamp
}

TEST(LinearProgram, saysWhichRowCannotBeMet) {
  LinearProgram p;
  p.a = {3, 2, {1, 1, 0.2, 0.1, 2, 1}};
  p.atLeast = {1, 0.5, 1};
  p.cost = {1, 1};
  const auto solution = minimise(p);
  ASSERT_FALSE(solution);
  EXPECT_EQ(solution.error(),
            "infeasible: row 1 gets 0.3 instead of at least 0.5 when all rows together miss least; ask for less");
  const auto least = leastMiss(p);
  ASSERT_TRUE(least) << least.error();
  EXPECT_NEAR(least.value().sum, 0.2, 1e-9);
  EXPECT_NEAR(least.value().miss[1], 0.2, 1e-9);
  EXPECT_NEAR(least.value().x[0], 1, 1e-9);
  p.atLeast = {};
  p.atMost = {-1, 1, 1};
  EXPECT_NE(minimise(p).error().find("row 0 gets 0 instead of at most -1"), std::string::npos);
}

TEST(LinearProgram, refusesWhatHasNoEndOrTheWrongSize) {
  LinearProgram p;
  p.a = {1, 1, {1}};
  p.atLeast = {0};
  p.cost = {-1};
  p.upper = {kUnbounded};
  EXPECT_NE(minimise(p).error().find("unbounded"), std::string::npos);
  p.cost = {1, 2};
  EXPECT_EQ(minimise(p).error(), "cost: has 2 numbers instead of 1");
}

TEST(LeastSquares, withoutBoundsInReachSolvesTheSystem) {
  const DenseMatrix a = randomMatrix(30, 5, 1);
  const std::vector<double> truth{0.2, 0.4, 0.6, 0.8, 0.5};
  std::vector<double> b, x(5, 0.0);
  for (size_t r = 0; r < 30; ++r) b.push_back(received(a, r, truth));
  const NormalEquations equations = normalEquations(a, b);
  EXPECT_LE(minimiseSquares(equations, {}, x), 1e-10);
  for (size_t c = 0; c < 5; ++c) EXPECT_NEAR(x[c], truth[c], 1e-8);
  EXPECT_NEAR(missOf(equations, x), 0, 1e-9);
}

// At a lower bound the slope may only be positive, at an upper one only negative, between them it is zero: enough for a
// convex problem.
TEST(LeastSquares, meetsItsOptimalityConditions) {
  for (const size_t columns : {3, 20, 60}) {
    const DenseMatrix a = randomMatrix(3 * columns, columns, columns);
    Rng rng(7, columns, 0);
    std::vector<double> b, weights, upper;
    for (size_t r = 0; r < a.rows; ++r) {
      b.push_back(static_cast<double>(rng.uniform() * static_cast<float>(columns)));
      weights.push_back(static_cast<double>(rng.uniform()));
    }
    for (size_t c = 0; c < columns; ++c) upper.push_back(c % 4 ? 0.8 : 2.5);
    const NormalEquations equations = normalEquations(a, b, weights);
    std::vector<double> x(columns, 0.5);
    EXPECT_LE(minimiseSquares(equations, upper, x), 1e-9);
    size_t atBounds = 0;
    for (size_t c = 0; c < columns; ++c) {
      double slope = 0;
      for (size_t r = 0; r < a.rows; ++r) slope += weights[r] * a.row(r)[c] * (received(a, r, x) - b[r]);
      slope /= equations.h[c];
      atBounds += x[c] <= 0 || x[c] >= upper[c];
      EXPECT_TRUE(x[c] <= 0 || slope <= 1e-8) << slope;
      EXPECT_TRUE(x[c] >= upper[c] || slope >= -1e-8) << slope;
    }
    EXPECT_GT(atBounds, 0u);  // or the bounds were not tested
    double direct = 0;
    for (size_t r = 0; r < a.rows; ++r) direct += weights[r] * std::pow(received(a, r, x) - b[r], 2);
    EXPECT_NEAR(missOf(equations, x), direct, 1e-9 * direct);
  }
}

TEST(LeastSquares, agreesWithTryingEveryDimming) {
  const DenseMatrix a = randomMatrix(9, 3, 3);
  std::vector<double> b(9, 1.9), x(3, 0.0);
  const NormalEquations equations = normalEquations(a, b);
  minimiseSquares(equations, {}, x);
  constexpr int kSteps = 50;
  double best = kUnbounded;
  for (int i = 0; i <= kSteps; ++i)
    for (int j = 0; j <= kSteps; ++j)
      for (int k = 0; k <= kSteps; ++k)
        best = std::min(
            best, missOf(equations, std::vector<double>{i / double{kSteps}, j / double{kSteps}, k / double{kSteps}}));
  EXPECT_LE(missOf(equations, x), best + 1e-12);
  EXPECT_GT(missOf(equations, x), best - 0.05);
}

TEST(LeastSquares, takesEqualAndDarkLamps) {
  // Two lamps alike and one that lights nothing: G is singular, the miss is still least.
  DenseMatrix a = randomMatrix(20, 4, 9);
  for (size_t r = 0; r < 20; ++r) a.row(r)[1] = a.row(r)[0], a.row(r)[3] = 0;
  std::vector<double> b(20, 1.0), x(4, 0.3), two{0.3, 0.3};
  DenseMatrix slim{20, 2, {}};
  for (size_t r = 0; r < 20; ++r) slim.values.insert(slim.values.end(), {a.row(r)[0], a.row(r)[2]});
  const NormalEquations equations = normalEquations(a, b), slimmer = normalEquations(slim, b);
  EXPECT_LE(minimiseSquares(equations, {}, x), 1e-9);
  minimiseSquares(slimmer, std::vector<double>{2, 1}, two);  // one lamp that reaches twice as far
  EXPECT_NEAR(missOf(equations, x), missOf(slimmer, two), 1e-9);
  EXPECT_EQ(x[3], 0.3);
}

TEST(LeastSquares, withAPriceComesCloseToTheLinearProgramsLuxForItsWatts) {
  // What the program needs for its lux is the least: least squares that spend as much cannot have every point at the
  // target and more.
  const LinearProgram p = randomProgram(40, 6, 4);
  const auto solution = minimise(p);
  ASSERT_TRUE(solution) << solution.error();
  NormalEquations equations = normalEquations(p.a, p.atLeast);
  for (double price = 0; price < 2; price += 0.05) {
    NormalEquations priced = equations;
    for (size_t c = 0; c < 6; ++c) priced.h[c] -= price * p.cost[c];
    std::vector<double> x(6, 1.0);
    minimiseSquares(priced, {}, x);
    double watts = 0, shortest = kUnbounded;
    for (size_t c = 0; c < 6; ++c) watts += p.cost[c] * x[c];
    for (size_t r = 0; r < p.a.rows; ++r) shortest = std::min(shortest, received(p.a, r, x) / p.atLeast[r]);
    EXPECT_LE(shortest, std::max(1.0, watts / solution.value().cost) + 1e-9);
  }
}

}  // namespace
}  // namespace roomlight::search
