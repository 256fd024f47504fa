// Logarithm and power of two as plain arithmetic, so that loops over them become vector code. Errors are those of a
 // float or two.
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
  return static_cast<float>(exponent) +
         kTwoOverLn2 * s * (1 + s2 * (1.0f / 3 + s2 * (1.0f / 5 + s2 * (1.0f / 7 + s2 * (1.0f / 9)))));
}

// 2^y, relative error below 2e-7; y is taken to lie within -126 and 127. By the series of the exponential.
inline float fastExp2(float y) {
  const float held = y < -126 ? -126.0f : y > 127 ? 127.0f : y;
  const float whole = std::floor(held + 0.5f);
  const float t = (held - whole) * 0.693147181f;  // at most 0.35
  const float e =
      1 + t * (1 + t * (1.0f / 2 +
                        t * (1.0f / 6 + t * (1.0f / 24 + t * (1.0f / 120 + t * (1.0f / 720 + t * (1.0f / 5040)))))));
  return e * std::bit_cast<float>((static_cast<int32_t>(whole) + 127) << 23);
}

// atan2(y, x), absolute error below 3e-7; 0 for 0, 0. By a polynomial (Abramowitz and Stegun 1964, 4.4.50).
inline float fastAtan2(float y, float x) {
  constexpr float kHalfTurn = 3.14159265f;
  const float ax = std::abs(x), ay = std::abs(y), most = ax > ay ? ax : ay;
  if (!(most > 0)) return 0;
  const float t = (ax > ay ? ay : ax) / most, t2 = t * t;
  const float a =
      t * (1 + t2 * (-0.3333314528f +
                     t2 * (0.1999355085f +
                           t2 * (-0.1420889944f +
                                 t2 * (0.1065626393f +
                                       t2 * (-0.0752896400f +
                                             t2 * (0.0429096138f + t2 * (-0.0161657367f + t2 * 0.0028662257f))))))));
  const float steep = ay > ax ? kHalfTurn / 2 - a : a, turned = x < 0 ? kHalfTurn - steep : steep;
  return y < 0 ? -turned : turned;
}

// x^exponent of a positive normal number.
inline float fastPow(float x, float exponent) { return fastExp2(exponent * fastLog2(x)); }

}  // namespace roomlight
