// Designs to objectives, many at once.
#pragma once

#include "optimise/model.h"

namespace roomlight::optimise {

// What can be said of one design in one condition.
struct ZoneResult {
  double meanLux = 0, leastLux = 0, mostLux = 0;
  double u0() const { return meanLux > 0 ? leastLux / meanLux : 0; }
};
struct ConditionResult {
  std::vector<ZoneResult> zones;   // all, also those that are not judged
  std::vector<double> ugr;         // per eye; 0: none to speak of
  std::vector<double> ratios;
  double wattsW = 0;               // drawn in it
};
struct DesignResult {
  std::vector<ConditionResult> conditions;
  double missPercent = 0, unevenness = 0, glare = 0, kWhPerYear = 0, cost = 0, installedW = 0;
  size_t fittings = 0;
  double of(Objective objective) const;
};

// All about one design.
DesignResult resultOf(const Model& model, search::ConstGenome design);
// Its rows in a condition, as Model's columns have them.
std::vector<float> rowsOf(const Model& model, search::ConstGenome design, size_t condition);

// objectives[i * model.objectives.size() + m] of every design, on all threads. A design costs lamps × rows × conditions
// multiplications: 2 to 20 µs.
void evaluateAll(const Model& model, const search::Genomes& designs, std::span<double> objectives);

// The search's problem: designs by chance, evaluation, repair and polish of designs of this model, which must stay
// where it is.
search::Problem problemOf(const Model& model);

// Designs with few lamps: from one to all places taken with even chances, at 0.3 to full light. Every method draws its
// designs by chance here, the random search each of its generations.
search::Genomes sparseDesigns(const Model& model, size_t count, uint64_t seed, size_t generation = 0);

}  // namespace roomlight::optimise
