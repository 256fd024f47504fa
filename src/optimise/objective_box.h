// The part of objective space that counts, and how much of it a front has below it.
#pragma once

#include "optimise/model.h"
#include "search/archive.h"

namespace roomlight::optimise {

// The best that could be, and a tenth more than the worst that can be: what lies on a limit still counts.
struct ObjectiveBox {
  std::vector<double> ideal, reference;
};
ObjectiveBox boxOf(const Model& model);

// The share of the box that a front dominates. With four objectives, where it is dear, of at most kHypervolumePoints
// that are spread over the front.
constexpr size_t kHypervolumePoints = 300;
double hypervolumeOf(const Model& model, const search::Archive& front);

}  // namespace roomlight::optimise
