// Fronts: their ranks and crowding distances (Deb et al. 2002), what is selected by these, and how much a front
// dominates.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace roomlight::search {

struct Ranking {
  std::vector<uint32_t> rank;    // 0: dominated by none; 1: by none once those of rank 0 are gone; and so on
  std::vector<double>
      crowding;  // within the rank: sum over objectives of the distance between both neighbours, in ranges of the rank
};

// objectives: point after point. Efficient nondominated sort (Zhang, Tian, Cheng and Jin 2015).
Ranking rankPoints(std::span<const double> objectives, size_t objectivesEach);

// The crowded comparison: a goes before b.
inline bool before(const Ranking& ranking, size_t a, size_t b) {
  return ranking.rank[a] != ranking.rank[b] ? ranking.rank[a] < ranking.rank[b]
                                            : ranking.crowding[a] > ranking.crowding[b];
}

// The best `count` points, best first; equal ones in their order.
std::vector<size_t> selectBest(const Ranking& ranking, size_t count);

// The part of objective space that a front dominates, up to a reference point (Zitzler and Thiele 1999): one number for
// how good it is. objectives: point after point, reference.size() (two to four) each. Points that are not better than
// the reference in every objective add nothing. Exact. 500 points cost about 0.1 ms with two objectives, 1 ms with
// three, 100 ms with four.
double hypervolume(std::span<const double> objectives, std::span<const double> reference);

// The share of the box between ideal and reference, 0 to 1: the same for any units of the objectives.
double hypervolumeShare(std::span<const double> objectives, std::span<const double> ideal,
                        std::span<const double> reference);

}  // namespace roomlight::search
