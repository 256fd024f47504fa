// Children of two parents for mixed variables (docs/methods/search.md). Reals: simulated binary crossover and
// polynomial mutation (Deb and Agrawal 1995, Deb and Goyal 1996). Integers: uniform crossover, mutation to another
// value; ordered ones half the time to one close by. Groups are inherited whole.
#pragma once

#include <vector>

#include "search/blocks.h"
#include "search/draws.h"
#include "search/methods.h"

namespace roomlight::search {

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
