// Ranks of nondominated fronts and crowding distances (Deb et al. 2002), and what is selected by them.
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

}  // namespace roomlight::search
