// Designs to objectives, many at once; how good a front is, and how fast that goes.
#pragma once

#include "optimise/model.h"
#include "search/archive.h"

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

// The part of objective space that counts, and how much of it a front has below it. The best that could be, and a tenth
// more than the worst that can be: what lies on a limit still counts.
struct ObjectiveBox {
  std::vector<double> ideal, reference;
};
ObjectiveBox boxOf(const Model& model);

// The share of the box that a front dominates. With four objectives, where it is dear, of at most kHypervolumePoints
// that are spread over the front.
constexpr size_t kHypervolumePoints = 300;
double hypervolumeOf(const Model& model, const search::Archive& front);

// How many designs this machine evaluates in a second, of such as the search makes at first; on all threads.
double designsASecond(const Model& model);

// What the simplest surrogate costs, for comparison: each design's nearest neighbours are looked up among the designs
// of the front, by their dimming and kinds of lamps; on all threads. 0: there is no front.
constexpr size_t kNeighbours = 5;
double lookUpsASecond(const Model& model, const search::Archive& front);

}  // namespace roomlight::optimise
