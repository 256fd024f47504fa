// Light of places where gathering rays arrive, each lit by few rays, as far as their neighbours tell it better: nested
// grids of cells on one surface, the mean of each drawn towards that of the next larger one by how uncertain it is
// beside how much cells of its size differ (empirical Bayes, Efron & Morris 1975). What single rays found far beyond
// what all should is spread over the largest.
#pragma once

#include <span>

#include "gather/hit_cache.h"

namespace roomlight {

// Changes `even` and `rare` of all samples. Of what shares a largest cell only what has a free way to the same place is
// put together. The result does not depend on the number of threads.
void smoothLight(const RayScene& rays, const HitCache& cells, std::span<LitHit> samples);

}  // namespace roomlight
