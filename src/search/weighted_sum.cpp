// The rival of one objective: for each of a set of weightings a small genetic search of its own, all of them in step,
// so that a run can end at any time. Objectives are scaled by the range of the front so far. Every design goes into the
// archive, not only the winners.
#include <algorithm>
#include <numeric>

#include "search/draws.h"
#include "search/generation.h"
#include "search/variation.h"

namespace roomlight::search {
namespace {

// All ways to share `parts` among the objectives from `m` on (Das and Dennis 1998).
void shareOut(std::vector<size_t>& shares, size_t m, size_t parts, std::vector<std::vector<double>>& out) {
  if (m + 1 == shares.size()) {
    shares[m] = parts;
    const double total = static_cast<double>(std::accumulate(shares.begin(), shares.end(), size_t{0}));
    std::vector<double> weights;
    for (size_t share : shares) weights.push_back(static_cast<double>(share) / total);
    out.push_back(std::move(weights));
    return;
  }
  for (size_t part = 0; part <= parts; ++part) {
    shares[m] = part;
    shareOut(shares, m + 1, parts - part, out);
  }
}

double weightedSum(std::span<const double> objectives, const std::vector<double>& weights, const Range& range) {
  double sum = 0;
  for (size_t m = 0; m < weights.size(); ++m) {
    const double width = range.highest[m] - range.lowest[m];
    // A little of every objective, so that of designs equal in one the better in the others wins.
    sum += (weights[m] + 1e-3) * (objectives[m] - range.lowest[m]) / (width > 0 ? width : 1);
  }
  return sum;
}

std::vector<double> sumsOf(const std::vector<double>& objectives, const std::vector<double>& weights,
                           const Range& range) {
  const size_t m = weights.size();
  std::vector<double> sums(objectives.size() / m);
  for (size_t i = 0; i < sums.size(); ++i)
    sums[i] = weightedSum(std::span(objectives).subspan(i * m, m), weights, range);
  return sums;
}

}  // namespace

std::vector<std::vector<double>> weightings(size_t objectives, size_t about) {
  std::vector<std::vector<double>> out;
  for (size_t parts = 1; out.size() < about; ++parts) {
    out.clear();
    std::vector<size_t> shares(objectives);
    shareOut(shares, 0, parts, out);
  }
  return out;
}

void weightedGeneration(const Problem& problem, State& state) {
  const size_t m = problem.objectives, n = kWeightedPopulation;
  const auto all = weightings(m, state.settings.weightings);
  const Range range = rangeOf(state.archive);
  // Parents of every weighting by tournament among its own.
  std::vector<size_t> winners;
  for (size_t w = 0; w < all.size(); ++w) {
    const std::vector<double> sums = sumsOf(state.objectives, all[w], range);
    for (size_t i = 0; i < n; ++i) {
      Draws draws(state.settings.seed, state.generation, Purpose::parents, w * n + i);
      const size_t a = w * n + draws.index(n), b = w * n + draws.index(n);
      winners.push_back(sums[b] < sums[a] ? b : a);
    }
  }
  Genomes designs = state.population;
  const Genomes children =
      offspring(problem, state.settings, state.generation, pick(state.population, winners), state.population);
  designs.append(children);
  const std::vector<double> found = evaluate(problem, state, children);
  std::vector<double> objectives = state.objectives;
  objectives.insert(objectives.end(), found.begin(), found.end());
  // The best of its parents and children go on, scaled by what is known now.
  const Range newRange = rangeOf(state.archive);
  std::vector<size_t> best;
  for (size_t w = 0; w < all.size(); ++w) {
    const std::vector<double> sums = sumsOf(objectives, all[w], newRange);
    std::vector<size_t> order(2 * n);
    for (size_t i = 0; i < n; ++i) order[i] = w * n + i, order[n + i] = state.population.count + w * n + i;
    std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) { return sums[a] < sums[b]; });
    best.insert(best.end(), order.begin(), order.begin() + static_cast<ptrdiff_t>(n));
  }
  state.population = pick(designs, best);
  state.objectives = pick(objectives, m, best);
}

}  // namespace roomlight::search
