// Logarithm and power of two as plain arithmetic, so that loops over them become vector code. Errors are those of a float or two.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

namespace roomlight {

// log2 of a positive normal number; absolute error below 1.5e-7 near 1, else one part in 1e7. By the series of artanh.
inline float fastLog2(float x) {
  constexpr int kRootOfHalf = 0x3f3504f3;
  const auto bits = std::bit_cast<int32_t>(x);
  const int32_t exponent = (bits - kRootOfHalf) >> 23;
  const float m = std::bit_cast<float>(bits - (exponent << 23));  // between the roots of 1/2 and 2
  const float s = (m - 1) / (m + 1), s2 = s * s;
  constexpr float kTwoOverLn2 = 2.88539008f;
  return static_cast<float>(exponent) + kTwoOverLn2 * s * (1 + s2 * (1.0f / 3 + s2 * (1.0f / 5 + s2 * (1.0f / 7 + s2 * (1.0f / 9)))));
}

// 2^y, relative error below 2e-7; y is taken to lie within -126 and 127. By the series of the exponential.
inline float fastExp2(float y) {
  const float held = y < -126 ? -126.0f : y > 127 ? 127.0f
                                                  : y;
  const float whole = std::floor(held + 0.5f);
  const float t = (held - whole) * 0.693147181f;  // at most 0.35
  const float e = 1 + t * (1 + t * (1.0f / 2 + t * (1.0f / 6 + t * (1.0f / 24 + t * (1.0f / 120 + t * (1.0f / 720 + t * (1.0f / 5040)))))));
  return e * std::bit_cast<float>((static_cast<int32_t>(whole) + 127) << 23);
}

// x^exponent of a positive normal number.
inline float fastPow(float x, float exponent) { return fastExp2(exponent * fastLog2(x)); }

}  // namespace roomlight
