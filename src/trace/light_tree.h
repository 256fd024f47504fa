// Chooses one of many lights by what groups of them could give at a place: a binary tree over their places, with bounds
// on where they shine (after Conty Estevez & Kulla 2018, "Importance sampling of many lights with adaptive tree
// splitting"). Without shadows.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "base/sampling.h"
#include "base/vec.h"

namespace roomlight {

class LightTree {
 public:
  struct Light {
    Bounds3 bounds;  // m
    float intensityCd;  // where it is strongest
    Vec3 axis{0, 1, 0};  // unit
    float halfAngle = kPi;  // rad: it shines only within this angle of the axis
  };
  struct Choice {
    size_t index = 0;
    float chance = 0;  // 0: nothing chosen
    float rest = 0;  // what is left of u, rescaled to [0, 1)
  };

  LightTree() = default;
  explicit LightTree(const std::vector<Light>& lights);
  bool empty() const { return nodes_.empty(); }
  // `u` in [0, 1); weigh(index): what that light could give at p, 0 only where it gives nothing. Groups near p are
  // taken apart first, so that no light beside it is lost in one.
  template <class Weigh>
  Choice choose(Vec3 p, float u, const Weigh& weigh) const;
  // Chance with which choose(p) chooses light `index`.
  template <class Weigh>
  float chance(size_t index, Vec3 p, const Weigh& weigh) const;

  // For who chooses among groups by what more is known of them: nodes are numbered from 0, which holds all.
  size_t nodeCount() const { return nodes_.size(); }
  bool isLeaf(uint32_t node) const { return nodes_[node].right == 0; }
  uint32_t left(uint32_t node) const { return node + 1; }  // of nodes that are no leaves
  uint32_t right(uint32_t node) const { return nodes_[node].right; }
  uint32_t parent(uint32_t node) const { return nodes_[node].parent; }
  uint32_t leafOf(size_t index) const { return leafOf_[index]; }
  bool holds(uint32_t node, size_t index) const { return placeOf_[index] - nodes_[node].first < nodes_[node].count; }
  // Whether it is seen from somewhere within `from` under so wide an angle that one weight says little of all its
  // lights.
  bool isWide(uint32_t node, const Bounds3& from) const;
  // What its lights could give at p.
  template <class Weigh>
  float weight(uint32_t node, Vec3 p, const Weigh& weigh) const {
    return isLeaf(node) ? weightOfLeaf(nodes_[node], weigh) : importance(nodes_[node], p);
  }
  // One of its lights alone, and the chance of that.
  template <class Weigh>
  Choice chooseIn(uint32_t node, Vec3 p, float u, const Weigh& weigh) const;
  template <class Weigh>
  float chanceIn(uint32_t node, size_t index, Vec3 p, const Weigh& weigh) const;

 private:
  struct Node {
    Vec3 centre, axis;
    float radius2, halfAngle, cd;
    uint32_t first, count;  // of order_, in leaves
    uint32_t right = 0;  // the left child follows; 0: a leaf
    uint32_t parent = 0;
  };
  static constexpr uint32_t kLeaf = 8;  // lights that are weighed one by one
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
    for (uint32_t i = 0; i < cut.count; ++i) cut.total += cut.weight[i] = weight(cut.node[i], p, weigh);
  }

  std::vector<Node> nodes_;
  std::vector<uint32_t> order_, placeOf_, leafOf_;  // placeOf_: of a light, in order_
};

template <class Weigh>
LightTree::Choice LightTree::chooseIn(uint32_t at, Vec3 p, float u, const Weigh& weigh) const {
  float chance = 1;
  while (!isLeaf(at)) {
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
float LightTree::chanceIn(uint32_t node, size_t index, Vec3 p, const Weigh& weigh) const {
  const float own = weigh(index), ofLeaf = own > 0 ? weightOfLeaf(nodes_[leafOf_[index]], weigh) : 0;
  if (!(ofLeaf > 0)) return 0;
  float chance = own / ofLeaf;
  for (uint32_t at = leafOf_[index]; at != node;) {
    const uint32_t parent = nodes_[at].parent;
    const float share = shareOfLeft(parent, p);
    if (share < 0) return 0;
    chance *= at == parent + 1 ? share : 1 - share;
    at = parent;
  }
  return chance;
}

template <class Weigh>
LightTree::Choice LightTree::choose(Vec3 p, float u, const Weigh& weigh) const {
  Cut cut;
  weighCut(p, cut, weigh);
  if (!(cut.total > 0)) return {};
  const size_t chosen = chooseByWeight(
      cut.count, cut.total, [&](size_t i) { return cut.weight[i]; }, u);
  Choice c = chooseIn(cut.node[chosen], p, u, weigh);
  c.chance *= cut.weight[chosen] / cut.total;
  return c;
}

template <class Weigh>
float LightTree::chance(size_t index, Vec3 p, const Weigh& weigh) const {
  if (!(weigh(index) > 0)) return 0;
  Cut cut;
  weighCut(p, cut, weigh);
  uint32_t top = 0;
  while (!holds(cut.node[top], index)) ++top;
  return cut.total > 0 ? chanceIn(cut.node[top], index, p, weigh) * cut.weight[top] / cut.total : 0;
}

}  // namespace roomlight
