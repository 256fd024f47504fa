// Designs made better without trying them out: repaired, polished by the best dimming, and made by linear programs to
// begin with.
#pragma once

#include "optimise/model.h"

namespace roomlight::optimise {

// Takes lamps out until those left keep their distance, the most of their rule, and the limits of watts, cost and
// fittings: lamps that are dimmed least stay, of equal ones those of earlier places. A design that keeps all of it
// stays as it is.
void repair(const Model& model, search::Genome design);

// What a design breaks, in words; empty: nothing.
std::string brokenBy(const Model& model, search::ConstGenome design);

// The best dimming of given lamps: linear programs, exact but for uniformity. Makes the dimming of a design's lamps
// best for the wish: least weighted sum of energy, of price and number in proportion to light (so that lamps hardly
// needed go out), and of what targets of mean illuminance and uniformity (at the darkest points) are missed by; no
// eye's glare and no luminance ratio gets above its limit, or above what it was. Where glare is above its limit,
// dimming below it is tried too. Returns its cost in evaluations (search/problem.h); 0: nothing in the wish can be
// helped by dimming.
size_t polish(const Model& model, search::Genome design, const search::Wish& wish);

// Least watts in a condition with lamps that are given, so that every zone's mean reaches its target; uniformity and
// glare are not asked for. Errors: cannot be reached.
struct LeastWatts {
  double wattsW = 0;
  std::vector<double> dimming;  // per chosen lamp
};
Result<LeastWatts> leastWatts(const Model& model, search::ConstGenome design, size_t condition);

// Designs to begin with, by linear programs over every lamp at every place at once.
struct RelaxedDesigns {
  search::Genomes designs;
  size_t evaluations = 0;  // what they cost, in evaluations of a design
};

// For each of `count` trade-offs between what objectives weigh, the same every time, the first with most weight on
// targets: every lamp may be bought in part, with all limits in proportion; then of each place the lamp that is bought
// most stays, the design is repaired and polished. None where dimming is not free, targets are no objective, or the
// programs would be too large.
RelaxedDesigns relaxedDesigns(const Model& model, size_t count);

}  // namespace roomlight::optimise
