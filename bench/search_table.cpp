// The figures of docs/measured/search.md, as Markdown (scripts/measure_search). Usage: search_table [SEEDS]; 10 by
 // default.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>

#include "base/progress.h"
#include "base/random.h"
#include "search/dimming.h"
#include "search/front.h"
#include "search/search.h"
#include "search/test_problems.h"

namespace roomlight::bench {
namespace {

using namespace search;

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const size_t n = values.size();
  return n % 2 ? values[n / 2] : 0.5 * (values[n / 2 - 1] + values[n / 2]);
}

double volumeOf(const TestProblem& test, const State& state) {
  return hypervolume(state.archive.objectives, test.reference);
}

void hypervolumes(uint64_t seeds) {
  fmt::print("## Hypervolume after 20,000 evaluations\n\nMedian, and lowest to highest, of {} seeds.\n\n", seeds);
  fmt::print(
      "| problem | limit | asked | method | median | lowest | highest | s |\n|---|---|---|---|---|---|---|---|\n");
  for (const TestProblem& test : {zdt1(), zdt2(), zdt3(), dtlz2(), mixedZdt1(), lampRow()}) {
    for (const MethodInfo& row : methodTable()) {
      if (row.method == Method::hybrid && !test.problem.polish) continue;
      std::vector<double> volumes, times;
      for (uint64_t seed = 1; seed <= seeds; ++seed) {
        State state = start(test.problem, {.method = row.method, .seed = seed, .evaluations = 20'000});
        run(test.problem, state);
        volumes.push_back(volumeOf(test, state)), times.push_back(state.seconds);
      }
      const auto figure = [](double v) { return v > 0 ? fmt::format("{:.4f}", v) : std::string("–"); };
      fmt::print("| {} | {} | {} | {} | {:.4f} | {:.4f} | {:.4f} | {:.2f} |\n", test.name, figure(test.bestHypervolume),
                 figure(test.askedHypervolume), row.name, median(volumes),
                 *std::min_element(volumes.begin(), volumes.end()), *std::max_element(volumes.begin(), volumes.end()),
                 median(times));
      std::fflush(stdout);
    }
  }
}

struct Effort {
  double evaluations = 0, seconds = 0;
};

// Until the archive holds `volume`; nothing if it does not within the budget.
std::optional<Effort> effortFor(const TestProblem& test, const Settings& settings, double volume) {
  State state = start(test.problem, settings);
  while (volumeOf(test, state) < volume) {
    if (finished(state)) return std::nullopt;
    advance(test.problem, state);
  }
  return Effort{static_cast<double>(state.evaluations), state.seconds};
}

void hybridAgainstPlain(uint64_t seeds) {
  fmt::print("\n## Hybrid against NSGA-II without polish\n\n");
  fmt::print(
      "How much the hybrid needs for the hypervolume that `nsga2` reaches in 20,000 evaluations with the same "
      "seed.\n\n");
  fmt::print(
      "| problem | evaluations, median | highest | share of 20,000 | time, median | share of nsga2's "
      "|\n|---|---|---|---|---|---|\n");
  for (const TestProblem& test : {mixedZdt1(), lampRow()}) {
    std::vector<double> evaluations, times, shares;
    for (uint64_t seed = 1; seed <= seeds; ++seed) {
      State plain = start(test.problem, {.method = Method::nsga2, .seed = seed, .evaluations = 20'000});
      run(test.problem, plain);
      const auto effort =
          effortFor(test, {.method = Method::hybrid, .seed = seed, .evaluations = 40'000}, volumeOf(test, plain));
      evaluations.push_back(effort ? effort->evaluations : INFINITY),
          times.push_back(effort ? effort->seconds : INFINITY);
      shares.push_back(times.back() / plain.seconds);
    }
    fmt::print("| {} | {:.0f} | {:.0f} | {:.2f} | {:.3f} s | {:.2f} |\n", test.name, median(evaluations),
               *std::max_element(evaluations.begin(), evaluations.end()), median(evaluations) / 20'000, median(times),
               median(shares));
  }
}

void overhead() {
  fmt::print("\n## What the search itself costs\n\n");
  fmt::print(
      "Microseconds a design with 100,000 evaluations, those of the test problem (under a microsecond) included.\n\n");
  fmt::print("| problem | population | method | µs |\n|---|---|---|---|\n");
  for (const TestProblem& test : {zdt1(), dtlz2(), lampRow()})
    for (const size_t population : {size_t{100}, size_t{400}})
      for (const MethodInfo& row : methodTable()) {
        State state = start(test.problem, {.method = row.method, .evaluations = 100'000, .population = population});
        run(test.problem, state);
        fmt::print("| {} | {} | {} | {:.1f} |\n", test.name, population, row.name,
                   1e6 * state.seconds / static_cast<double>(state.evaluations));
      }
}

// Lamps in a grid over points in a grid, light by the inverse square; a target everywhere that full power reaches 1.5
// times.
LinearProgram dimmingProblem(size_t lamps, size_t points, uint64_t seed) {
  Rng rng(0, 0, seed);
  LinearProgram p;
  p.a = {points, lamps, std::vector<double>(points * lamps)};
  std::vector<Vec2> at(lamps);
  for (Vec2& lamp : at) lamp = rng.uniform2() * 6.0f;
  double least = INFINITY;
  for (size_t r = 0; r < points; ++r) {
    const Vec2 point = rng.uniform2() * 6.0f;
    double sum = 0;
    for (size_t c = 0; c < lamps; ++c) {
      const Vec2 d = point - at[c];
      const double square = static_cast<double>(d.x * d.x + d.y * d.y) + 4;
      sum += p.a.row(r)[c] = 1000 / (square * square) + 5;
    }
    least = std::min(least, sum);
  }
  p.atLeast.assign(points, least / 1.5);
  for (size_t c = 0; c < lamps; ++c) p.cost.push_back(5 + 15 * static_cast<double>(rng.uniform()));
  return p;
}

void dimming() {
  fmt::print(
      "\n## Dimming\n\nLeast watts for a lux target at every point (linear program), and bounded least squares to the "
      "same target from x = 0.5.\n\n");
  fmt::print(
      "| lamps | points | linear program, ms | least squares, µs | violation of its optimality "
      "|\n|---|---|---|---|---|\n");
  for (const auto& [lamps, points] : {std::pair<size_t, size_t>{8, 50}, {20, 100}, {40, 500}, {60, 2000}}) {
    std::vector<double> linearMs, squaresUs;
    double violation = 0;
    for (uint64_t seed = 0; seed < 10; ++seed) {
      const LinearProgram p = dimmingProblem(lamps, points, seed);
      const Stopwatch linear;
      if (const auto solution = minimise(p); !solution) fmt::print(stderr, "{}\n", solution.error());
      linearMs.push_back(1e3 * linear.seconds());
      const NormalEquations equations = normalEquations(p.a, p.atLeast);
      constexpr int kRepeats = 20;
      const Stopwatch squares;
      for (int repeat = 0; repeat < kRepeats; ++repeat) {
        std::vector<double> x(lamps, 0.5);
        violation = std::max(violation, minimiseSquares(equations, {}, x));
      }
      squaresUs.push_back(1e6 * squares.seconds() / kRepeats);
    }
    fmt::print("| {} | {} | {:.2f} | {:.1f} | {:.0e} |\n", lamps, points, median(linearMs), median(squaresUs),
               violation);
  }
}

}  // namespace
}  // namespace roomlight::bench

int main(int count, char** words) {
  const auto seeds = static_cast<uint64_t>(count > 1 ? std::max(1, std::atoi(words[1])) : 10);
  roomlight::bench::hypervolumes(seeds);
  roomlight::bench::hybridAgainstPlain(seeds);
  roomlight::bench::overhead();
  roomlight::bench::dimming();
}
