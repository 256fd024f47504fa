// Warps from the unit square to discs, hemispheres and cones, each with its density. Directions are local, z up.
#pragma once

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

}  // namespace roomlight
