// Designs to begin with, by linear programs over every lamp at every place at once.
#pragma once

#include "optimise/model.h"

namespace roomlight::optimise {

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
