// Lighting proposals: places, kinds, aims and dimming of lamps on the best trade-offs between goals.
#pragma once

#include <map>
#include <vector>

#include "roomlight/basics.h"

namespace ROOMLIGHT_NAMESPACE {

struct OptimiseOptions {
  std::string method = "hybrid";  // hybrid, nsga2, pagmo, weighted or random
  std::string quality = "good";
  std::optional<size_t> evaluations = {};  // instead of the study's
  std::optional<int> certified = {};  // designs that are solved in full, likewise
  std::optional<uint64_t> seed = {};  // likewise
  std::optional<double> metresPerUnit = {};  // of the home
  double seconds = 0;  // of the search at most; 0: no limit
  int threads = 0;  // 0: all cores
};

struct Design {
  std::string name = {};  // "design 1"
  std::map<std::string, double> objectives = {};  // by name: "targetMiss", ...
  size_t fittings = 0;
  double installedW = 0;
  std::vector<std::string> lightingFiles = {};  // in the folder; one a condition
  std::optional<double> largestDifferencePercent = {};  // from the full solution; none: not certified
};

// `home`, `study` (docs/reference/optimise.md): files. `folder`: for index.html, front.csv and lighting files; what it
// holds of the same inputs is not found again, so that what was cancelled goes on.
ROOMLIGHT_API Result<std::vector<Design>> optimise(const std::string& home, const std::string& study,
                                                   const std::string& folder, const OptimiseOptions& options = {},
                                                   const Progress& progress = {});

}  // namespace ROOMLIGHT_NAMESPACE
