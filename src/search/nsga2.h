// NSGA-II (Deb, Pratap, Agarwal and Meyarivan 2002): parents by tournament, children by variation.h, the best of both
// go on. And the hybrid, in which some of them are polished.
#pragma once

#include "search/generation.h"
#include "search/nondominated.h"

namespace roomlight::search {

// Winners of `count` binary tournaments by the crowded comparison.
std::vector<size_t> tournaments(const Ranking& ranking, const State& state, size_t count);

// Σ = 1, >= 0: more weight on the objectives in which the design is already good, so that a polish takes it on towards
// its part of the front (Deb and Goel 2001); then divided by the objectives' ranges.
std::vector<double> weightsFor(std::span<const double> objectives, const Range& range);

}  // namespace roomlight::search
