// Noise that hides the bands of 8 bits.
#pragma once

#include <cmath>

namespace roomlight {

// 0 to 1, even over small neighbourhoods: interleaved gradient noise (Jimenez 2014, "Next generation post processing in
// Call of Duty").
inline float ditherAt(int x, int y) {
  const float inner = 0.06711056f * static_cast<float>(x) + 0.00583715f * static_cast<float>(y);
  const float v = 52.9829189f * (inner - std::floor(inner));
  return v - std::floor(v);
}

}  // namespace roomlight
