// The best dimming of given lamps: linear programs, exact but for uniformity.
#pragma once

#include "optimise/model.h"

namespace roomlight::optimise {

// Makes the dimming of a design's lamps best for the wish: least weighted sum of energy, of price and number in
// proportion to light (so that lamps hardly needed go out), and of what targets of mean illuminance and uniformity (at
// the darkest points) are missed by; no eye's glare and no luminance ratio gets above its limit, or above what it was.
// Where glare is above its limit, dimming below it is tried too. Returns its cost in evaluations (search/problem.h); 0:
// nothing in the wish can be helped by dimming.
size_t polish(const Model& model, search::Genome design, const search::Wish& wish);

// Least watts in a condition with lamps that are given, so that every zone's mean reaches its target; uniformity and
// glare are not asked for. Errors: cannot be reached.
struct LeastWatts {
  double wattsW = 0;
  std::vector<double> dimming;  // per chosen lamp
};
Result<LeastWatts> leastWatts(const Model& model, search::ConstGenome design, size_t condition);

}  // namespace roomlight::optimise
