#include "search/methods.h"

#include <array>
#include <string>

namespace roomlight::search {
namespace {

constexpr std::array kMethods{
    MethodInfo{Method::hybrid, "hybrid",
               "NSGA-II by blocks of what belongs together; the best of each generation are polished"},
    MethodInfo{Method::nsga2, "nsga2", "NSGA-II with variation for mixed variables"},
    MethodInfo{Method::pagmoNsga2, "pagmo", "NSGA-II as pagmo has it"},
    MethodInfo{Method::weightedSum, "weighted", "genetic searches for one weighted sum of the objectives each"},
    MethodInfo{Method::random, "random", "random designs"},
};

}  // namespace

std::span<const MethodInfo> methodTable() { return kMethods; }

const char* nameOf(Method method) {
  for (const MethodInfo& row : kMethods)
    if (row.method == method) return row.name;
  return "";
}

Result<Method> methodNamed(std::string_view name) {
  std::string known;
  for (const MethodInfo& row : kMethods) {
    if (row.name == name) return row.method;
    known += (known.empty() ? "" : ", ") + std::string(row.name);
  }
  return Error{"method: unknown \"" + std::string(name) + "\"; use one of " + known};
}

size_t archiveLimit(const Settings& settings, size_t objectives) {
  return settings.archive > 0 ? settings.archive : objectives == 2 ? 500 : 1500;
}

Status check(const Problem& problem, const Settings& settings) {
  if (Status bad = check(problem); !bad) return bad;
  if (settings.population < 8 || settings.population % 4) return Error{"population: give a multiple of 4, at least 8"};
  if (settings.evaluations < 1) return Error{"evaluations: give at least 1"};
  if (!(settings.seconds >= 0)) return Error{"seconds: give 0 for no limit, or more"};
  if (settings.archive > 0 && settings.archive < 8) return Error{"archive: give at least 8, or 0 for the default"};
  if (!(settings.crossoverRate >= 0 && settings.crossoverRate <= 1)) return Error{"crossoverRate: give 0 to 1"};
  if (!(settings.crossoverIndex >= 1 && settings.crossoverIndex < 100)) return Error{"crossoverIndex: give 1 to 99"};
  if (!(settings.mutationRate >= 0 && settings.mutationRate <= 1)) return Error{"mutationRate: give 0 to 1"};
  if (!(settings.mutationIndex >= 1 && settings.mutationIndex < 100)) return Error{"mutationIndex: give 1 to 99"};
  if (!(settings.polishShare >= 0 && settings.polishShare < 1))
    return Error{"polishShare: give 0 or more, and less than 1"};
  if (settings.weightings < 2 || settings.weightings > 1000) return Error{"weightings: give 2 to 1000"};
  return Ok{};
}

}  // namespace roomlight::search
