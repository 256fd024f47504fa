// One of a few things, by weights.
#pragma once

#include <algorithm>
#include <cstddef>

namespace roomlight {

// The largest float below 1.
constexpr float kBelowOne = 0x1.fffffep-1f;

// Index of the weight in whose share of `total`, the sum of all and above 0, `u` in [0, 1) falls; never of a weight of
// 0. Rescales u to [0, 1) within that share.
template <class WeightAt>
size_t chooseByWeight(size_t count, float total, const WeightAt& weightAt, float& u) {
  float v = u * total;
  size_t last = 0;
  for (size_t i = 0; i < count; ++i) {
    const float w = weightAt(i);
    if (!(w > 0)) continue;
    last = i;
    if (v < w) break;
    v -= w;
  }
  u = std::clamp(v / weightAt(last), 0.0f, kBelowOne);
  return last;
}

}  // namespace roomlight
