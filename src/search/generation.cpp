#include "search/generation.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "base/parallel.h"
#include "search/draws.h"

namespace roomlight::search {

namespace {

// Every value of every variable is as likely as any other.
Genomes anyDesigns(const Problem& problem, const State& state, size_t count) {
  Genomes designs = problem.none();
  designs.resize(count);
  for (size_t d = 0; d < count; ++d) {
    Draws draws(state.settings.seed, state.generation, Purpose::first, d);
    const Genome genome = designs[d];
    for (size_t i = 0; i < genome.integers.size(); ++i)
      genome.integers[i] = static_cast<int32_t>(draws.index(static_cast<size_t>(problem.integers[i].cardinality)));
    for (double& x : genome.reals) x = draws.uniform();
  }
  return designs;
}

}  // namespace

Genomes randomDesigns(const Problem& problem, const State& state, size_t count) {
  Genomes designs =
      problem.draw ? problem.draw(count, state.settings.seed, state.generation) : anyDesigns(problem, state, count);
  repairAll(problem, designs);
  return designs;
}

void repairAll(const Problem& problem, Genomes& designs) {
  if (!problem.repair) return;
  parallelFor(designs.count, 16, [&](size_t i) { problem.repair(designs[i]); });
  assert(fits(problem, designs));
}

std::vector<double> evaluate(const Problem& problem, State& state, const Genomes& designs) {
  std::vector<double> objectives(designs.count * problem.objectives);
  if (designs.count == 0) return objectives;
  problem.evaluate(designs, objectives);
  assert(std::all_of(objectives.begin(), objectives.end(), [](double f) { return std::isfinite(f); }));
  state.evaluations += designs.count;
  add(state.archive, designs, objectives);
  return objectives;
}

Genomes pick(const Genomes& designs, const std::vector<size_t>& order) {
  Genomes picked;
  picked.integersEach = designs.integersEach;
  picked.realsEach = designs.realsEach;
  for (size_t i : order) picked.append(designs[i]);
  return picked;
}

std::vector<double> pick(const std::vector<double>& objectives, size_t objectivesEach,
                         const std::vector<size_t>& order) {
  std::vector<double> picked;
  for (size_t i : order)
    for (size_t m = 0; m < objectivesEach; ++m) picked.push_back(objectives[i * objectivesEach + m]);
  return picked;
}

// The simplest rival: nothing is learnt from one design to the next.
void randomGeneration(const Problem& problem, State& state) {
  state.population = randomDesigns(problem, state, state.settings.population);
  state.objectives = evaluate(problem, state, state.population);
}

}  // namespace roomlight::search
