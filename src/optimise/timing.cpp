#include "optimise/evaluate.h"

#include <algorithm>
#include <array>
#include <limits>

#include "base/parallel.h"
#include "base/progress.h"

namespace roomlight::optimise {
namespace {

constexpr size_t kEvaluated = 20000, kLookedUp = 2000;

// Squares of dimming, and one for each place where another lamp hangs.
double distanceOf(search::ConstGenome a, search::ConstGenome b) {
  double sum = 0;
  for (size_t i = 0; i < a.integers.size(); ++i) sum += a.integers[i] != b.integers[i];
  for (size_t i = 0; i < a.reals.size(); ++i) sum += (a.reals[i] - b.reals[i]) * (a.reals[i] - b.reals[i]);
  return sum;
}

// Mean of the first objective over the nearest designs.
double lookUp(const search::Archive& front, search::ConstGenome design) {
  std::array<std::pair<double, size_t>, kNeighbours> nearest;
  nearest.fill({std::numeric_limits<double>::infinity(), 0});
  for (size_t i = 0; i < front.size(); ++i) {
    const std::pair<double, size_t> one{distanceOf(front.designs[i], design), i};
    if (one < nearest.back()) nearest.back() = one, std::sort(nearest.begin(), nearest.end());
  }
  double sum = 0;
  for (const auto& [distance, i] : nearest) sum += front.objectivesOf(i)[0];
  return sum / kNeighbours;
}

}  // namespace

double designsASecond(const Model& model) {
  const search::Genomes designs = sparseDesigns(model, kEvaluated, 1);
  std::vector<double> objectives(designs.count * model.objectives.size());
  const Stopwatch watch;
  evaluateAll(model, designs, objectives);
  return static_cast<double>(designs.count) / watch.seconds();
}

double lookUpsASecond(const Model& model, const search::Archive& front) {
  if (front.size() == 0) return 0;
  const search::Genomes designs = sparseDesigns(model, kLookedUp, 1);
  std::vector<double> found(designs.count);
  const Stopwatch watch;
  parallelFor(designs.count, 16, [&](size_t i) { found[i] = lookUp(front, designs[i]); });
  return static_cast<double>(designs.count) / watch.seconds();
}

}  // namespace roomlight::optimise
