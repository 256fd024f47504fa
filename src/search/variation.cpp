#include "search/variation.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>
#include <unordered_set>
#include <utility>

#include "base/parallel.h"
#include "search/generation.h"

namespace roomlight::search {
namespace {

constexpr int kTriesAgain = 4;
constexpr double kByBlocks = 0.8, kMoves = 0.5;  // of pairs, of children; docs/methods/search.md

// How far one side of simulated binary crossover spreads: from u uniform, with room to the bound of `room`
// half-distances of the parents.
double spread(double u, double room, double index) {
  const double alpha = 2 - std::pow(room, -(index + 1));
  return u <= 1 / alpha ? std::pow(u * alpha, 1 / (index + 1)) : std::pow(1 / (2 - u * alpha), 1 / (index + 1));
}

void crossReals(double& a, double& b, double index, Draws& draws) {
  const double low = std::min(a, b), high = std::max(a, b), width = high - low;
  if (width < 1e-14) return;
  const double u = draws.uniform();
  const double below = 0.5 * (low + high - spread(u, 1 + 2 * low / width, index) * width);
  const double above = 0.5 * (low + high + spread(u, 1 + 2 * (1 - high) / width, index) * width);
  a = std::clamp(below, 0.0, 1.0), b = std::clamp(above, 0.0, 1.0);
  if (draws.chance(0.5)) std::swap(a, b);
}

double mutateReal(double x, double index, Draws& draws) {
  const double u = draws.uniform(), power = 1 / (index + 1);
  if (u < 0.5) return std::clamp(x + std::pow(2 * u + (1 - 2 * u) * std::pow(1 - x, index + 1), power) - 1, 0.0, 1.0);
  return std::clamp(x + 1 - std::pow(2 * (1 - u) + (2 * u - 1) * std::pow(x, index + 1), power), 0.0, 1.0);
}

int32_t mutateInteger(int32_t value, const IntegerVariable& variable, Draws& draws) {
  const int32_t n = variable.cardinality;
  if (n < 2) return value;
  if (variable.ordered && draws.chance(0.5)) {
    int32_t step = 1;
    while (step < n - 1 && draws.chance(0.5)) ++step;
    const int32_t to = draws.chance(0.5) ? value + step : value - step;
    if (to >= 0 && to < n) return to;
  }
  const auto other = static_cast<int32_t>(draws.index(static_cast<size_t>(n - 1)));
  return other < value ? other : other + 1;
}

// Whether the two children exchange the variables of a group: one draw a group, of a variable alone one each.
class Exchange {
 public:
  explicit Exchange(Draws& draws) : draws_(draws) {}
  bool operator()(int32_t group) {
    if (group < 0) return draws_.chance(0.5);
    const auto at = static_cast<size_t>(group);
    if (at >= drawn_.size()) drawn_.resize(at + 1, -1);
    if (drawn_[at] < 0) drawn_[at] = draws_.chance(0.5);
    return drawn_[at] > 0;
  }

 private:
  Draws& draws_;
  std::vector<signed char> drawn_;
};

std::string bytesOf(ConstGenome genome) {
  std::string bytes(genome.integers.size_bytes() + genome.reals.size_bytes(), '\0');
  if (!genome.integers.empty()) std::memcpy(bytes.data(), genome.integers.data(), genome.integers.size_bytes());
  if (!genome.reals.empty())
    std::memcpy(bytes.data() + genome.integers.size_bytes(), genome.reals.data(), genome.reals.size_bytes());
  return bytes;
}

}  // namespace

void cross(const Problem& problem, const Settings& settings, Genome a, Genome b, Draws& draws) {
  if (!draws.chance(settings.crossoverRate)) return;
  Exchange exchange(draws);
  for (size_t i = 0; i < a.integers.size(); ++i)
    if (exchange(problem.integers[i].group)) std::swap(a.integers[i], b.integers[i]);
  for (size_t i = 0; i < a.reals.size(); ++i) {
    const int32_t group = problem.reals[i].group;
    if (group >= 0 && exchange(group)) std::swap(a.reals[i], b.reals[i]);
    if (draws.chance(0.5)) crossReals(a.reals[i], b.reals[i], settings.crossoverIndex, draws);
  }
}

void mutate(const Problem& problem, const Settings& settings, Genome genome, Draws& draws, bool atLeastOne) {
  const size_t integers = genome.integers.size(), variables = integers + genome.reals.size();
  const double rate = settings.mutationRate > 0 ? settings.mutationRate : 1 / static_cast<double>(variables);
  const size_t certain = atLeastOne ? draws.index(variables) : variables;
  for (size_t i = 0; i < integers; ++i)
    if (i == certain || draws.chance(rate))
      genome.integers[i] = mutateInteger(genome.integers[i], problem.integers[i], draws);
  for (size_t i = 0; i < genome.reals.size(); ++i)
    if (integers + i == certain || draws.chance(rate))
      genome.reals[i] = mutateReal(genome.reals[i], settings.mutationIndex, draws);
}

Genomes offspring(const Problem& problem, const Settings& settings, size_t generation, const Genomes& parents,
                  const Genomes& known, const Blocks& blocks) {
  Genomes children = parents;
  parallelFor(children.count / 2, 16, [&](size_t pair) {
    Draws draws(settings.seed, generation, Purpose::vary, pair);
    const Genome a = children[2 * pair], b = children[2 * pair + 1];
    if (blocks.any() && draws.chance(kByBlocks)) {
      if (draws.chance(settings.crossoverRate)) blocks.exchange(a, b, draws);
    } else {
      cross(problem, settings, a, b, draws);
    }
    for (const Genome& child : {a, b}) {
      mutate(problem, settings, child, draws);
      if (blocks.any() && draws.chance(kMoves)) blocks.move(child, draws);
    }
    if (problem.repair) problem.repair(a), problem.repair(b);
  });
  // A design known already would waste its evaluation.
  std::unordered_set<std::string> seen;
  for (size_t i = 0; i < known.count; ++i) seen.insert(bytesOf(known[i]));
  for (size_t i = 0; i < children.count; ++i) {
    Draws draws(settings.seed, generation, Purpose::again, i);
    for (int tries = 0; !seen.insert(bytesOf(children[i])).second && tries < kTriesAgain; ++tries) {
      mutate(problem, settings, children[i], draws, true);
      if (problem.repair) problem.repair(children[i]);
    }
  }
  return children;
}

}  // namespace roomlight::search
