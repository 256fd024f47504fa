// How fast designs are judged on this machine.
#pragma once

#include "optimise/model.h"
#include "search/archive.h"

namespace roomlight::optimise {

// Evaluated, of designs as the search makes them at first, on all threads.
double designsASecond(const Model& model);

// What the simplest surrogate costs, for comparison: each design's nearest neighbours are looked up among the designs
// of the front, by their dimming and kinds of lamps; on all threads. 0: there is no front.
constexpr size_t kNeighbours = 5;
double lookUpsASecond(const Model& model, const search::Archive& front);

}  // namespace roomlight::optimise
