// Warps from the unit square to discs, hemispheres and cones, each with its density; even points of the square; choices
// by weights. Directions are local, z up.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "base/vec.h"

namespace roomlight {

// Uniform on the unit disc; concentric map (Shirley & Chiu 1997).
inline Vec2 sampleDisc(Vec2 u) {
  const float a = 2 * u.x - 1, b = 2 * u.y - 1;
  if (a == 0 && b == 0) return {0, 0};
  float r, phi;
  if (std::abs(a) > std::abs(b)) {
    r = a, phi = (kPi / 4) * (b / a);
  } else {
    r = b, phi = kPi / 2 - (kPi / 4) * (a / b);
  }
  return {r * std::cos(phi), r * std::sin(phi)};
}

// Density cos(theta)/pi per steradian.
inline Vec3 sampleCosineHemisphere(Vec2 u) {
  const Vec2 d = sampleDisc(u);
  return {d.x, d.y, std::sqrt(std::max(0.0f, 1 - d.x * d.x - d.y * d.y))};
}
inline float cosineHemispherePdf(float cosTheta) { return std::max(0.0f, cosTheta) / kPi; }

// Density 1/(4 pi).
inline Vec3 sampleSphere(Vec2 u) {
  const float z = 1 - 2 * u.x, r = std::sqrt(std::max(0.0f, 1 - z * z)), phi = 2 * kPi * u.y;
  return {r * std::cos(phi), r * std::sin(phi), z};
}

// Uniform in the cone about +z with the given 1 - cos of its half-angle; density 1/(2 pi (1 - cos)). Not by the cosine
// itself, which rounds to 1 for a disc of a hundredth of a degree.
inline Vec3 sampleCone(Vec2 u, float oneMinusCos) {
  const float h = u.x * oneMinusCos, r = std::sqrt(std::max(0.0f, h * (2 - h))), phi = 2 * kPi * u.y;
  return {r * std::cos(phi), r * std::sin(phi), 1 - h};
}
inline float conePdf(float oneMinusCos) { return 1 / (2 * kPi * oneMinusCos); }

// Barycentric weights of vertices 1 and 2, uniform over a triangle (Heitz 2019).
inline Vec2 sampleTriangle(Vec2 u) {
  float b0 = u.x, b1 = u.y;
  if (b1 > b0) {
    b0 *= 0.5f, b1 -= b0;
  } else {
    b1 *= 0.5f, b0 -= b1;
  }
  return {b0, b1};
}

// Power heuristic with exponent two (Veach 1997).
inline float misWeight(float pdfA, float pdfB) {
  const float a = pdfA * pdfA, b = pdfB * pdfB;
  return a > 0 ? a / (a + b) : 0;
}

// Point i of n of a Fibonacci lattice: spread evenly over the unit square, the same in every run.
inline Vec2 latticePoint(int i, int n) {
  constexpr float kGoldenRatio = 0.618034f;
  return {(static_cast<float>(i) + 0.5f) / static_cast<float>(n),
          std::fmod(static_cast<float>(i) * kGoldenRatio, 1.0f)};
}

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
