#include "search/search.h"

#include <algorithm>
#include <cassert>

#include "base/progress.h"
#include "search/generation.h"

namespace roomlight::search {
namespace {

struct Steps {
  Method method;
  Generation first;  // after the first designs; may be null
  Generation next;
};

constexpr Steps kSteps[] = {{Method::hybrid, hybridStart, hybridGeneration},
                            {Method::nsga2, nullptr, nsga2Generation},
                            {Method::pagmoNsga2, nullptr, pagmoGeneration},
                            {Method::weightedSum, nullptr, weightedGeneration},
                            {Method::random, nullptr, randomGeneration}};

const Steps& stepsOf(Method method) {
  return *std::find_if(std::begin(kSteps), std::end(kSteps), [&](const Steps& s) { return s.method == method; });
}

}  // namespace

State start(const Problem& problem, const Settings& settings, const Genomes& first) {
  assert(check(problem, settings));
  const Stopwatch watch;
  State state;
  state.settings = settings;
  state.archive.limit = archiveLimit(settings, problem.objectives);
  state.archive.objectivesEach = problem.objectives;
  state.archive.designs = problem.none();
  size_t count = settings.population;
  if (settings.method == Method::weightedSum)
    count = kWeightedPopulation * weightings(problem.objectives, settings.weightings).size();
  state.population = randomDesigns(problem, state, count);
  for (size_t i = 0; i < std::min(first.count, count); ++i) state.population.assign(i, first[i]);
  repairAll(problem, state.population);
  state.objectives = evaluate(problem, state, state.population);
  if (const Generation also = stepsOf(settings.method).first) also(problem, state);
  state.generation = 1;
  state.seconds = watch.seconds();
  return state;
}

bool finished(const State& state) {
  return state.evaluations >= state.settings.evaluations ||
         (state.settings.seconds > 0 && state.seconds >= state.settings.seconds);
}

void advance(const Problem& problem, State& state) {
  const Stopwatch watch;
  stepsOf(state.settings.method).next(problem, state);
  ++state.generation;
  state.seconds += watch.seconds();
}

void run(const Problem& problem, State& state, const Progress& progress,
         const std::function<void(const State&)>& watch) {
  while (!finished(state) && !progress.stop()) {
    advance(problem, state);
    if (watch) watch(state);
    progress.at(static_cast<float>(fractionDone(state)));
  }
}

double fractionDone(const State& state) {
  const Settings& s = state.settings;
  const double byCount = static_cast<double>(state.evaluations) / static_cast<double>(s.evaluations);
  return std::min(1.0, std::max(byCount, s.seconds > 0 ? state.seconds / s.seconds : 0));
}

double secondsLeft(const State& state) {
  const double done = fractionDone(state);
  return done > 0 ? state.seconds * (1 - done) / done : 0;
}

}  // namespace roomlight::search
