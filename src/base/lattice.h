// Points spread evenly over the unit square, the same in every run.
#pragma once

#include <cmath>

#include "base/vec.h"

namespace roomlight {

// Point i of n of a Fibonacci lattice.
inline Vec2 latticePoint(int i, int n) {
  constexpr float kGoldenRatio = 0.618034f;
  return {(static_cast<float>(i) + 0.5f) / static_cast<float>(n),
          std::fmod(static_cast<float>(i) * kGoldenRatio, 1.0f)};
}

}  // namespace roomlight
