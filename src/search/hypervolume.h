// The part of objective space that a front dominates, up to a reference point (Zitzler and Thiele 1999): one number for
// how good it is.
#pragma once

#include <span>

namespace roomlight::search {

// objectives: point after point, reference.size() (two to four) each. Points that are not better than the reference in
// every objective add nothing. Exact. 500 points cost about 0.1 ms with two objectives, 1 ms with three, 100 ms with
// four.
double hypervolume(std::span<const double> objectives, std::span<const double> reference);

// The share of the box between ideal and reference, 0 to 1: the same for any units of the objectives.
double hypervolumeShare(std::span<const double> objectives, std::span<const double> ideal,
                        std::span<const double> reference);

}  // namespace roomlight::search
