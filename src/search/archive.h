// All nondominated designs seen so far. Once there are a fifth more than `limit`, those in the densest places go, down
 // to it.
#pragma once

#include <span>
#include <vector>

#include "search/problem.h"

namespace roomlight::search {

// a is no worse in any objective and better in one.
bool dominates(std::span<const double> a, std::span<const double> b);

struct Archive {
  size_t limit = 500;
  size_t objectivesEach = 2;
  Genomes designs;
  std::vector<double> objectives;  // designs.count × objectivesEach

  size_t size() const { return designs.count; }
  std::span<const double> objectivesOf(size_t i) const {
    return std::span(objectives).subspan(i * objectivesEach, objectivesEach);
  }
};

// Adds what is nondominated and new in its objectives; thins out to the limit when there are a fifth more.
// Costs new × size × objectives, and size² × objectives when thinned.
void add(Archive& archive, const Genomes& designs, std::span<const double> objectives);

// Leaves at most `most`, evenly spread: again and again the design closest to its nearest neighbour goes, distances
// measured in ranges of the front (the truncation of SPEA2: Zitzler, Laumanns and Thiele 2001). The best of each
// objective always stays.
void thin(Archive& archive, size_t most);

// Lowest and highest of each objective in the archive; of an empty one nothing.
struct Range {
  std::vector<double> lowest, highest;
};
Range rangeOf(const Archive& archive);

// Order of the designs: by the first objective, then the second, and so on; for tables and equal files.
std::vector<size_t> sorted(const Archive& archive);

}  // namespace roomlight::search
