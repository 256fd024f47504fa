// All that is taken from pagmo 2 (Biscani and Izzo 2020), in one source since its headers compile slowly: hypervolume,
// and its NSGA-II with batch evaluation.
#include <algorithm>
#include <cmath>
#include <functional>

#include "search/draws.h"
#include "search/front.h"
#include "search/generation.h"

#include <pagmo/algorithms/nsga2.hpp>
#include <pagmo/bfe.hpp>
#include <pagmo/population.hpp>
#include <pagmo/problem.hpp>
#include <pagmo/utils/hypervolume.hpp>

namespace roomlight::search {
namespace {

using Points = std::vector<pagmo::vector_double>;

Points pointsOf(std::span<const double> objectives, size_t each) {
  Points points(objectives.size() / each);
  for (size_t i = 0; i < points.size(); ++i) {
    const std::span<const double> point = objectives.subspan(i * each, each);
    points[i].assign(point.begin(), point.end());
  }
  return points;
}

// pagmo wants one vector of doubles a design: reals first, then integers.
struct Layout {
  const Problem* problem = nullptr;
  size_t size() const { return problem->reals.size() + problem->integers.size(); }
  void encode(ConstGenome genome, double* x) const {
    x = std::copy(genome.reals.begin(), genome.reals.end(), x);
    for (int32_t value : genome.integers) *x++ = value;
  }
  void decode(const double* x, Genome genome) const {
    std::copy_n(x, genome.reals.size(), genome.reals.begin());
    x += genome.reals.size();
    for (int32_t& value : genome.integers) value = static_cast<int32_t>(std::lround(*x++));
  }
  Genomes decodeAll(const pagmo::vector_double& all) const {
    Genomes designs = problem->none();
    designs.resize(all.size() / size());
    for (size_t i = 0; i < designs.count; ++i) decode(&all[i * size()], designs[i]);
    repairAll(*problem, designs);
    return designs;
  }
};

// pagmo copies it and asks for its bounds; designs are evaluated in batches only.
struct PagmoProblem {
  Layout layout;
  pagmo::vector_double fitness(const pagmo::vector_double&) const {
    return pagmo::vector_double(layout.problem->objectives, 0.0);
  }
  std::pair<pagmo::vector_double, pagmo::vector_double> get_bounds() const {
    pagmo::vector_double low(layout.size(), 0.0), high(layout.size(), 1.0);
    for (size_t i = 0; i < layout.problem->integers.size(); ++i)
      high[layout.problem->reals.size() + i] = layout.problem->integers[i].cardinality - 1;
    return {low, high};
  }
  pagmo::vector_double::size_type get_nobj() const { return layout.problem->objectives; }
  pagmo::vector_double::size_type get_nix() const { return layout.problem->integers.size(); }
};

struct PagmoBatch {
  Layout layout;
  State* state = nullptr;
  pagmo::vector_double operator()(const pagmo::problem&, const pagmo::vector_double& all) const {
    return evaluate(*layout.problem, *state, layout.decodeAll(all));
  }
};

}  // namespace

double hypervolume(std::span<const double> objectives, std::span<const double> reference) {
  Points inside;
  for (auto& point : pointsOf(objectives, reference.size()))
    if (std::equal(point.begin(), point.end(), reference.begin(), std::less<>())) inside.push_back(std::move(point));
  if (inside.empty()) return 0;
  return pagmo::hypervolume(std::move(inside), false).compute({reference.begin(), reference.end()});
}

double hypervolumeShare(std::span<const double> objectives, std::span<const double> ideal,
                        std::span<const double> reference) {
  const size_t m = reference.size();
  std::vector<double> scaled(objectives.size());
  for (size_t i = 0; i < scaled.size(); ++i)
    scaled[i] = std::max(0.0, (objectives[i] - ideal[i % m]) / (reference[i % m] - ideal[i % m]));
  return hypervolume(scaled, std::vector<double>(m, 1.0));
}

void pagmoGeneration(const Problem& problem, State& state) {
  const Settings& s = state.settings;
  const Layout layout{&problem};
  // A generator of its own a generation, so that there is none to keep.
  pagmo::population population(pagmo::problem(PagmoProblem{layout}), 0u, 0u);
  pagmo::vector_double x(layout.size());
  for (size_t i = 0; i < state.population.count; ++i) {
    layout.encode(std::as_const(state.population)[i], x.data());
    const double* f = &state.objectives[i * problem.objectives];
    population.push_back(x, pagmo::vector_double(f, f + problem.objectives));
  }
  const double rate = s.mutationRate > 0 ? s.mutationRate : 1 / static_cast<double>(layout.size());
  const auto seed = static_cast<unsigned>(mix64(s.seed ^ mix64(state.generation)));
  pagmo::nsga2 algorithm(1u, std::min(s.crossoverRate, 0.999), s.crossoverIndex, rate, s.mutationIndex, seed);
  algorithm.set_bfe(pagmo::bfe(PagmoBatch{layout, &state}));
  const pagmo::population next = algorithm.evolve(population);
  pagmo::vector_double all;
  state.objectives.clear();
  for (size_t i = 0; i < next.size(); ++i) {
    all.insert(all.end(), next.get_x()[i].begin(), next.get_x()[i].end());
    state.objectives.insert(state.objectives.end(), next.get_f()[i].begin(), next.get_f()[i].end());
  }
  state.population = layout.decodeAll(all);
}

}  // namespace roomlight::search
