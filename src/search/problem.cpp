#include "search/problem.h"

#include <algorithm>
#include <cassert>

namespace roomlight::search {

void Genomes::resize(size_t designs) {
  count = designs;
  integers.resize(designs * integersEach);
  reals.resize(designs * realsEach);
}

void Genomes::append(ConstGenome genome) {
  assert(genome.integers.size() == integersEach && genome.reals.size() == realsEach);
  integers.insert(integers.end(), genome.integers.begin(), genome.integers.end());
  reals.insert(reals.end(), genome.reals.begin(), genome.reals.end());
  ++count;
}

void Genomes::append(const Genomes& others) {
  assert(others.integersEach == integersEach && others.realsEach == realsEach);
  integers.insert(integers.end(), others.integers.begin(), others.integers.end());
  reals.insert(reals.end(), others.reals.begin(), others.reals.end());
  count += others.count;
}

void Genomes::assign(size_t i, ConstGenome genome) {
  const Genome own = (*this)[i];
  std::copy(genome.integers.begin(), genome.integers.end(), own.integers.begin());
  std::copy(genome.reals.begin(), genome.reals.end(), own.reals.begin());
}

Genomes Problem::none() const {
  Genomes empty;
  empty.integersEach = integers.size();
  empty.realsEach = reals.size();
  return empty;
}

Status check(const Problem& problem) {
  if (problem.objectives < 2 || problem.objectives > 4) return Error{"objectives: give two to four"};
  if (problem.integers.empty() && problem.reals.empty()) return Error{"variables: there is nothing to change"};
  for (size_t i = 0; i < problem.integers.size(); ++i)
    if (problem.integers[i].cardinality < 1)
      return Error{"integers[" + std::to_string(i) + "]: has no value to take; give it one or leave it out"};
  const auto hasNoBlock = [&](const auto& v) { return v.group >= static_cast<int32_t>(problem.blockOfGroup.size()); };
  if (!problem.blockOfGroup.empty() &&
      (std::any_of(problem.integers.begin(), problem.integers.end(), hasNoBlock) ||
       std::any_of(problem.reals.begin(), problem.reals.end(), hasNoBlock) ||
       *std::min_element(problem.blockOfGroup.begin(), problem.blockOfGroup.end()) < 0))
    return Error{"blockOfGroup: give every group a block, 0 or more"};
  if (!problem.evaluate) return Error{"evaluate: is missing"};
  return Ok{};
}

bool fits(const Problem& problem, const Genomes& genomes) {
  const size_t n = problem.integers.size();
  if (genomes.integersEach != n || genomes.realsEach != problem.reals.size()) return false;
  if (genomes.integers.size() != genomes.count * n || genomes.reals.size() != genomes.count * genomes.realsEach)
    return false;
  for (size_t i = 0; i < genomes.integers.size(); ++i)
    if (genomes.integers[i] < 0 || genomes.integers[i] >= problem.integers[i % n].cardinality) return false;
  return std::all_of(genomes.reals.begin(), genomes.reals.end(), [](double x) { return x >= 0 && x <= 1; });
}

}  // namespace roomlight::search
