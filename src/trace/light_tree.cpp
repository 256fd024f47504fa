#include "trace/light_tree.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace roomlight {
namespace {

constexpr float kLeast = 1e-4f;   // m²
constexpr float kWide = 1.4f;        // a group is split while p is within that many of its radii
constexpr float kSlack = 1e-3f;   // rad, for rounding

// The smallest cone around two.
void join(Vec3& axis, float& halfAngle, Vec3 otherAxis, float otherHalf) {
  if (halfAngle >= kPi || otherHalf >= kPi) {
    halfAngle = kPi;
    return;
  }
  const float between = std::acos(std::clamp(dot(axis, otherAxis), -1.0f, 1.0f));
  if (between + otherHalf <= halfAngle) return;
  if (between + halfAngle <= otherHalf) {
    axis = otherAxis, halfAngle = otherHalf;
    return;
  }
  const float half = 0.5f * (between + halfAngle + otherHalf);
  const Vec3 across = otherAxis - axis * dot(axis, otherAxis);
  if (!(length(across) > 1e-6f) && dot(axis, otherAxis) > 0) {
    halfAngle = std::min(kPi, std::max(halfAngle, between + otherHalf));
    return;
  }
  if (half >= kPi || !(length(across) > 1e-6f)) {
    halfAngle = kPi;
    return;
  }
  const float turn = half - halfAngle;
  axis = normalize(axis * std::cos(turn) + normalize(across) * std::sin(turn));
  halfAngle = half;
}

}  // namespace

LightTree::LightTree(const std::vector<Light>& lights)
    : order_(lights.size()), placeOf_(lights.size()), leafOf_(lights.size()) {
  if (lights.empty()) return;
  std::iota(order_.begin(), order_.end(), 0u);
  nodes_.reserve(2 * (lights.size() / (kLeaf / 2) + 1));
  build(lights, 0, static_cast<uint32_t>(lights.size()), 0);
  for (uint32_t i = 0; i < order_.size(); ++i) placeOf_[order_[i]] = i;
}

uint32_t LightTree::build(const std::vector<Light>& lights, uint32_t first, uint32_t count, uint32_t parent) {
  const auto at = static_cast<uint32_t>(nodes_.size());
  Bounds3 bounds, centres;
  Node node{};
  node.axis = lights[order_[first]].axis, node.halfAngle = lights[order_[first]].halfAngle;
  for (uint32_t i = first; i < first + count; ++i) {
    const Light& l = lights[order_[i]];
    bounds.add(l.bounds), centres.add(l.bounds.centre());
    node.cd += l.intensityCd;
    join(node.axis, node.halfAngle, l.axis, l.halfAngle);
  }
  node.centre = bounds.centre(), node.radius2 = 0.25f * lengthSquared(bounds.size());
  node.first = first, node.count = count, node.parent = parent;
  nodes_.push_back(node);
  if (count <= kLeaf) {
    for (uint32_t i = first; i < first + count; ++i) leafOf_[order_[i]] = at;
    return at;
  }
  const Vec3 size = centres.size();
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const uint32_t half = count / 2;
  const auto begin = order_.begin() + first;
  std::nth_element(begin, begin + half, begin + count, [&](uint32_t a, uint32_t b) {
    const float pa = lights[a].bounds.centre()[axis], pb = lights[b].bounds.centre()[axis];
    return pa < pb || (pa == pb && a < b);
  });
  build(lights, first, half, at);
  const uint32_t right = build(lights, first + half, count - half, at);
  nodes_[at].right = right;
  return at;
}

bool LightTree::isWide(uint32_t node, const Bounds3& from) const {
  const Vec3 c = nodes_[node].centre;
  return kWide * kWide * nodes_[node].radius2 > lengthSquared(c - max(from.lo, min(from.hi, c)));
}

float LightTree::importance(const Node& node, Vec3 p) const {
  const Vec3 d = p - node.centre;
  const float d2 = lengthSquared(d);
  if (node.halfAngle < kPi && d2 > node.radius2) {
    const float distance = std::sqrt(d2), off = std::acos(std::clamp(dot(d, node.axis) / distance, -1.0f, 1.0f));
    if (off - std::asin(std::sqrt(node.radius2) / distance) > node.halfAngle + kSlack) return 0;
  }
  return node.cd / std::max(d2, 0.25f * node.radius2 + kLeast);
}

float LightTree::shareOfLeft(uint32_t at, Vec3 p) const {
  const float l = importance(nodes_[at + 1], p), r = importance(nodes_[nodes_[at].right], p);
  return l + r > 0 ? l / (l + r) : -1;
}

void LightTree::cutAt(Vec3 p, Cut& cut) const {
  cut.node[0] = 0, cut.count = nodes_.empty() ? 0 : 1;
  for (uint32_t i = 0; i < cut.count && cut.count < kMostCut;) {
    const Node& node = nodes_[cut.node[i]];
    if (node.right > 0 && kWide * kWide * node.radius2 > lengthSquared(p - node.centre)) {
      cut.node[cut.count++] = node.right, ++cut.node[i];  // the left one in its place, to be looked at again
    } else {
      ++i;
    }
  }
}

}  // namespace roomlight
