// Chooses one of many lights by what groups of them could give at a place: a binary tree over their places, with bounds on where they shine (after Conty Estevez &
// Kulla 2018, "Importance sampling of many lights with adaptive tree splitting"). Without shadows.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "base/vec.h"
#include "base/weighted_choice.h"

namespace roomlight {

class LightTree {
 public:
  struct Light {
    Bounds3 bounds;      // m
    float intensityCd;   // where it is strongest
    Vec3 axis{0, 1, 0};  // unit
    float halfAngle = kPi;  // rad: it shines only within this angle of the axis
  };
  struct Choice {
    size_t index = 0;
    float chance = 0;  // 0: nothing chosen
    float rest = 0;    // what is left of u, rescaled to [0, 1)
  };

  LightTree() = default;
  explicit LightTree(const std::vector<Light>& lights);
  bool empty() const { return nodes_.empty(); }
  // `u` in [0, 1); weigh(index): what that light could give at p, 0 only where it gives nothing. Groups near p are taken apart first, so that no light beside it is lost in one.
  template <class Weigh>
  Choice choose(Vec3 p, float u, const Weigh& weigh) const;
  // Chance with which choose(p) chooses light `index`.
  template <class Weigh>
  float chance(size_t index, Vec3 p, const Weigh& weigh) const;

 private:
  struct Node {
    Vec3 centre, axis;
    float radius2, halfAngle, cd;
    uint32_t first, count;  // of order_, in leaves
    uint32_t right = 0;     // the left child follows; 0: a leaf
    uint32_t parent = 0;
  };
  static constexpr uint32_t kLeaf = 8;      // lights that are weighed one by one
  static constexpr uint32_t kMostCut = 48;  // groups that are weighed beside one another
  // Nodes that hold all lights, large ones only far from p.
  struct Cut {
    std::array<uint32_t, kMostCut> node;
    std::array<float, kMostCut> weight;
    uint32_t count = 0;
    float total = 0;
  };
  uint32_t build(const std::vector<Light>& lights, uint32_t first, uint32_t count, uint32_t parent);
  void cutAt(Vec3 p, Cut& cut) const;  // without weights
  float importance(const Node& node, Vec3 p) const;
  float shareOfLeft(uint32_t at, Vec3 p) const;  // of what both children could give; -1: nothing
  template <class Weigh>
  float weightOfLeaf(const Node& leaf, const Weigh& weigh) const {
    float sum = 0;
    for (uint32_t i = leaf.first; i < leaf.first + leaf.count; ++i) sum += weigh(order_[i]);
    return sum;
  }
  template <class Weigh>
  void weighCut(Vec3 p, Cut& cut, const Weigh& weigh) const {
    cutAt(p, cut);
    for (uint32_t i = 0; i < cut.count; ++i) {
      const Node& node = nodes_[cut.node[i]];
      cut.total += cut.weight[i] = node.right > 0 ? importance(node, p) : weightOfLeaf(node, weigh);
    }
  }

  std::vector<Node> nodes_;
  std::vector<uint32_t> order_, placeOf_, leafOf_;  // placeOf_: of a light, in order_
};

template <class Weigh>
LightTree::Choice LightTree::choose(Vec3 p, float u, const Weigh& weigh) const {
  Cut cut;
  weighCut(p, cut, weigh);
  if (!(cut.total > 0)) return {};
  const size_t chosen = chooseByWeight(
      cut.count, cut.total, [&](size_t i) { return cut.weight[i]; }, u);
  float chance = cut.weight[chosen] / cut.total;
  uint32_t at = cut.node[chosen];
  while (nodes_[at].right > 0) {
    const float share = shareOfLeft(at, p);
    if (share < 0) return {};
    if (u < share) {
      u /= share, chance *= share, ++at;
    } else {
      u = (u - share) / (1 - share), chance *= 1 - share, at = nodes_[at].right;
    }
    u = std::clamp(u, 0.0f, kBelowOne);
  }
  const Node& leaf = nodes_[at];
  std::array<float, kLeaf> weights{};
  float total = 0;
  for (uint32_t i = 0; i < leaf.count; ++i) total += weights[i] = weigh(order_[leaf.first + i]);
  if (!(total > 0)) return {};
  const size_t own = chooseByWeight(
      leaf.count, total, [&](size_t i) { return weights[i]; }, u);
  return {order_[leaf.first + own], chance * weights[own] / total, u};
}

template <class Weigh>
float LightTree::chance(size_t index, Vec3 p, const Weigh& weigh) const {
  const float own = weigh(index), ofLeaf = own > 0 ? weightOfLeaf(nodes_[leafOf_[index]], weigh) : 0;
  if (!(ofLeaf > 0)) return 0;
  Cut cut;
  weighCut(p, cut, weigh);
  const auto holds = [&](uint32_t at) { return placeOf_[index] >= nodes_[at].first && placeOf_[index] < nodes_[at].first + nodes_[at].count; };
  uint32_t top = 0;
  while (!holds(cut.node[top])) ++top;
  float chance = own / ofLeaf * cut.weight[top] / cut.total;
  for (uint32_t at = leafOf_[index]; at != cut.node[top];) {
    const uint32_t parent = nodes_[at].parent;
    const float share = shareOfLeft(parent, p);
    if (share < 0) return 0;
    chance *= at == parent + 1 ? share : 1 - share;
    at = parent;
  }
  return chance;
}

}  // namespace roomlight
