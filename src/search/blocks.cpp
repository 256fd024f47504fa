#include "search/variation.h"

#include <algorithm>
#include <utility>

namespace roomlight::search {
namespace {

constexpr int kTries = 8;  // to find two groups that can change places

}  // namespace

Blocks::Blocks(const Problem& problem) {
  groups_.resize(problem.blockOfGroup.size());
  for (size_t i = 0; i < problem.integers.size(); ++i) {
    const IntegerVariable& v = problem.integers[i];
    if (v.group < 0 || problem.blockOfGroup.empty()) continue;
    Group& group = groups_[static_cast<size_t>(v.group)];
    group.integers.push_back(i), group.cardinalities.push_back(v.cardinality);
  }
  for (size_t i = 0; i < problem.reals.size(); ++i) {
    if (const int32_t g = problem.reals[i].group; g >= 0 && !problem.blockOfGroup.empty())
      groups_[static_cast<size_t>(g)].reals.push_back(i);
  }
  for (size_t g = 0; g < groups_.size(); ++g) {
    groups_[g].block = static_cast<size_t>(problem.blockOfGroup[g]);
    if (groups_[g].block >= blocks_.size()) blocks_.resize(groups_[g].block + 1);
    blocks_[groups_[g].block].push_back(g);
  }
}

void Blocks::exchange(Genome a, Genome b, Draws& draws) const {
  for (const std::vector<size_t>& block : blocks_) {
    if (!draws.chance(0.5)) continue;
    for (const size_t g : block) {
      for (const size_t i : groups_[g].integers) std::swap(a.integers[i], b.integers[i]);
      for (const size_t i : groups_[g].reals) std::swap(a.reals[i], b.reals[i]);
    }
  }
}

bool Blocks::holdTheSame(ConstGenome genome, const Group& a, const Group& b) {
  return std::equal(a.integers.begin(), a.integers.end(), b.integers.begin(),
                    [&](size_t i, size_t j) { return genome.integers[i] == genome.integers[j]; });
}

void Blocks::move(Genome genome, Draws& draws) const {
  for (int tries = 0; tries < kTries; ++tries) {
    const Group& a = groups_[draws.index(groups_.size())];
    const std::vector<size_t>& block = blocks_[a.block];
    const Group& b = groups_[block[draws.index(block.size())]];
    if (a.cardinalities != b.cardinalities || a.reals.size() != b.reals.size() || holdTheSame(genome, a, b)) continue;
    for (size_t k = 0; k < a.integers.size(); ++k)
      std::swap(genome.integers[a.integers[k]], genome.integers[b.integers[k]]);
    for (size_t k = 0; k < a.reals.size(); ++k) std::swap(genome.reals[a.reals[k]], genome.reals[b.reals[k]]);
    return;
  }
}

}  // namespace roomlight::search
