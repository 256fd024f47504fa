// Children of two parents for mixed variables (docs/methods/search.md). Reals: simulated binary crossover and
// polynomial mutation (Deb and Agrawal 1995, Deb and Goyal 1996). Integers: uniform crossover, mutation to another
// value; ordered ones half the time to one close by. Groups are inherited whole.
#pragma once

#include <vector>

#include "search/draws.h"
#include "search/methods.h"
#include "search/problem.h"

namespace roomlight::search {

// Variation where groups of variables belong to blocks (Problem::blockOfGroup): what matters to each other is kept
// together, as building blocks are where linkage is known (Thierens and Goldberg 1993).
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

// Parents a and b are children before and after.
void cross(const Problem& problem, const Settings& settings, Genome a, Genome b, Draws& draws);

// Each variable with the mutation rate; with `atLeastOne` one of them for certain.
void mutate(const Problem& problem, const Settings& settings, Genome genome, Draws& draws, bool atLeastOne = false);

// One child for each parent, pair by pair (parents.count even), crossed, mutated and repaired. A child that equals one
// of `known` or another child is mutated again, a few times at most. Where there are blocks most pairs exchange them
// whole, and half the children have something moved.
Genomes offspring(const Problem& problem, const Settings& settings, size_t generation, const Genomes& parents,
                  const Genomes& known, const Blocks& blocks = {});

}  // namespace roomlight::search
