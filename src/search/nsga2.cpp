// NSGA-II (Deb, Pratap, Agarwal and Meyarivan 2002): parents by tournament, children by variation.h, the best of both
// go on. And the hybrid, in which some of them are polished.
#include "search/generation.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

#include "base/parallel.h"
#include "search/draws.h"
#include "search/variation.h"

namespace roomlight::search {
namespace {

// Of the polishes, those in a random direction: they fill gaps of the front where designs drift together.
constexpr double kAnyDirection = 0.3;
constexpr size_t kSuitors = 3;  // of which the nearest is taken

double widthOf(const Range& range, size_t m) {
  const double width = range.highest[m] - range.lowest[m];
  return width > 0 ? width : 1;
}

// Evenly over the simplex, divided by the ranges.
std::vector<double> randomWeights(const Range& range, Draws& draws) {
  std::vector<double> weights(range.lowest.size());
  double sum = 0;
  for (double& w : weights) sum += w = 1e-3 - std::log(1 - draws.uniform());
  for (size_t m = 0; m < weights.size(); ++m) weights[m] /= sum * widthOf(range, m);
  return weights;
}

// How many designs polishing may take now, so that its share of all evaluations stays what was set.
size_t polishesNow(const State& state) {
  const double each =
      state.polished ? static_cast<double>(state.polishEvaluations) / static_cast<double>(state.polished) : 2;
  const double others = static_cast<double>(state.evaluations - state.polishEvaluations);
  const double share = state.settings.polishShare;
  const double allowed = share / (1 - share) * others - static_cast<double>(state.polishEvaluations);
  return allowed < each ? 0 : std::min(static_cast<size_t>(allowed / each), state.settings.population);
}

// Polishes designs[which], evaluates the outcomes and appends them. Where there was nothing to polish, nothing is
// evaluated.
void polish(const Problem& problem, State& state, const std::vector<size_t>& which, Genomes& designs,
            std::vector<double>& objectives) {
  const size_t m = problem.objectives;
  Genomes tried = pick(designs, which);
  const Range range = rangeOf(state.archive);
  std::vector<size_t> costs(which.size());
  parallelFor(which.size(), 1, [&](size_t i) {
    const std::span<const double> f = std::span(objectives).subspan(which[i] * m, m);
    Draws draws(state.settings.seed, state.generation, Purpose::polish, i);
    const std::vector<double> weights =
        draws.chance(kAnyDirection) ? randomWeights(range, draws) : weightsFor(f, range);
    costs[i] = problem.polish(tried[i], Wish{weights, f});
  });
  std::vector<size_t> polished;
  for (size_t i = 0; i < which.size(); ++i) {
    if (costs[i] > 0) polished.push_back(i);
  }
  const Genomes better = pick(tried, polished);
  if (better.count == 0) return;
  assert(fits(problem, better));
  const size_t cost = std::accumulate(costs.begin(), costs.end(), size_t{0});
  const std::vector<double> found = evaluate(problem, state, better);
  state.evaluations += cost;
  state.polished += better.count;
  state.polishEvaluations += cost + better.count;
  designs.append(better);
  objectives.insert(objectives.end(), found.begin(), found.end());
}

void keepBest(const Problem& problem, State& state, const Genomes& designs, const std::vector<double>& objectives) {
  const std::vector<size_t> best = selectBest(rankPoints(objectives, problem.objectives), state.settings.population);
  state.population = pick(designs, best);
  state.objectives = pick(objectives, problem.objectives, best);
}

// The best of designs[from...], by rank and crowding among all.
std::vector<size_t> bestFrom(const Ranking& ranking, size_t from, size_t count) {
  std::vector<size_t> best = selectBest(ranking, ranking.rank.size());
  std::erase_if(best, [&](size_t i) { return i < from; });
  best.resize(std::min(best.size(), count));
  return best;
}

// Of each pair of winners the second gives way to one that stands nearer to the first, in ranges of the front: their
// blocks strike the same balance between objectives, so that they go together.
void mateNear(const Problem& problem, const State& state, std::vector<size_t>& winners) {
  const Range range = rangeOf(state.archive);
  const std::vector<size_t> all = winners;
  const auto distance = [&](size_t a, size_t b) {
    double squares = 0;
    for (size_t m = 0; m < problem.objectives; ++m) {
      const double d = (state.objectives[a * problem.objectives + m] - state.objectives[b * problem.objectives + m]) /
                       widthOf(range, m);
      squares += d * d;
    }
    return squares;
  };
  for (size_t i = 0; i + 1 < winners.size(); i += 2) {
    Draws draws(state.settings.seed, state.generation, Purpose::mates, i);
    for (size_t k = 1; k < kSuitors; ++k) {
      const size_t other = all[draws.index(all.size())];
      if (other == winners[i]) continue;
      if (winners[i + 1] == winners[i] || distance(other, winners[i]) < distance(winners[i + 1], winners[i]))
        winners[i + 1] = other;
    }
  }
}

void generation(const Problem& problem, State& state, bool hybrid) {
  const Ranking ranking = rankPoints(state.objectives, problem.objectives);
  const Blocks blocks = hybrid ? Blocks(problem) : Blocks();
  std::vector<size_t> winners = tournaments(ranking, state, state.settings.population);
  if (blocks.any()) mateNear(problem, state, winners);
  const Genomes parents = pick(state.population, winners);
  const Genomes children = offspring(problem, state.settings, state.generation, parents, state.population, blocks);
  const std::vector<double> found = evaluate(problem, state, children);
  const size_t old = state.population.count;
  Genomes all = state.population;
  all.append(children);
  std::vector<double> objectives = state.objectives;
  objectives.insert(objectives.end(), found.begin(), found.end());
  if (hybrid && problem.polish)
    polish(problem, state, bestFrom(rankPoints(objectives, problem.objectives), old, polishesNow(state)), all,
           objectives);
  keepBest(problem, state, all, objectives);
}

}  // namespace

std::vector<size_t> tournaments(const Ranking& ranking, const State& state, size_t count) {
  std::vector<size_t> winners(count);
  const size_t n = ranking.rank.size();
  for (size_t i = 0; i < count; ++i) {
    Draws draws(state.settings.seed, state.generation, Purpose::parents, i);
    const size_t a = draws.index(n), b = draws.index(n);
    winners[i] = before(ranking, b, a) ? b : a;
  }
  return winners;
}

std::vector<double> weightsFor(std::span<const double> objectives, const Range& range) {
  std::vector<double> weights(objectives.size());
  double sum = 0;
  for (size_t m = 0; m < weights.size(); ++m)
    sum += weights[m] = 0.01 + std::clamp((range.highest[m] - objectives[m]) / widthOf(range, m), 0.0, 1.0);
  for (size_t m = 0; m < weights.size(); ++m) weights[m] /= sum * widthOf(range, m);
  return weights;
}

void nsga2Generation(const Problem& problem, State& state) { generation(problem, state, false); }
void hybridGeneration(const Problem& problem, State& state) { generation(problem, state, true); }

void hybridStart(const Problem& problem, State& state) {
  if (!problem.polish) return;
  Genomes all = state.population;
  std::vector<double> objectives = state.objectives;
  polish(problem, state, bestFrom(rankPoints(objectives, problem.objectives), 0, polishesNow(state)), all, objectives);
  keepBest(problem, state, all, objectives);
}

}  // namespace roomlight::search
