// The methods of search and their settings. All count evaluations alike and keep what they find in the same archive, so
// that they can be compared: docs/methods/search.md.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "search/problem.h"

namespace roomlight::search {

enum class Method { hybrid, nsga2, pagmoNsga2, weightedSum, random };

struct MethodInfo {
  Method method;
  const char* name;  // as on the command line: hybrid, nsga2, pagmo, weighted, random
  const char* summary;  // one line
};

std::span<const MethodInfo> methodTable();
const char* nameOf(Method method);
Result<Method> methodNamed(std::string_view name);

struct Settings {
  Method method = Method::hybrid;  // without Problem::polish the same as nsga2
  uint64_t seed = 1;
  size_t evaluations = 20000;  // budget; a run ends with the generation that reaches it
  double seconds = 0;  // wall time budget; 0: none. Where a clock ends a run depends on the machine
  size_t population = 100;  // a multiple of 4, at least 8
  size_t archive = 0;  // nondominated designs kept, about (archive.h); 0: 500 with two objectives, 1500 with more
  double crossoverRate = 0.9;  // share of pairs that mix
  double crossoverIndex = 15;  // of simulated binary crossover; more: children closer to parents
  double mutationRate = 0;  // for each variable; 0: one over their number
  double mutationIndex = 20;  // of polynomial mutation
  double polishShare = 0.6;  // hybrid: of all evaluations, those that polishing may take
  size_t weightings = 10;  // weightedSum: about how many, evenly over the simplex
};

size_t archiveLimit(const Settings& settings, size_t objectives);

// Errors: of the problem, or a setting out of range.
Status check(const Problem& problem, const Settings& settings);

}  // namespace roomlight::search
