// Variation where groups of variables belong to blocks (Problem::blockOfGroup): what matters to each other is kept
// together, as building blocks are where linkage is known (Thierens and Goldberg 1993).
#pragma once

#include <vector>

#include "search/draws.h"
#include "search/problem.h"

namespace roomlight::search {

class Blocks {
 public:
  Blocks() = default;  // none
  explicit Blocks(const Problem& problem);
  bool any() const { return !blocks_.empty(); }

  // Each block goes to the other child whole, or stays.
  void exchange(Genome a, Genome b, Draws& draws) const;
  // Two groups of a block change places, if chance finds two alike in shape that hold something else.
  void move(Genome genome, Draws& draws) const;

 private:
  struct Group {
    std::vector<size_t> integers, reals;  // variables
    std::vector<int32_t> cardinalities;
    size_t block = 0;
  };
  static bool holdTheSame(ConstGenome genome, const Group& a, const Group& b);

  std::vector<Group> groups_;
  std::vector<std::vector<size_t>> blocks_;  // groups of each
};

}  // namespace roomlight::search
