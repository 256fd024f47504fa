// Sampling a triangle uniformly in the solid angle it subtends at a point (Arvo 1995), so that a lamp near the point
// has no 1/distance² spikes.
#pragma once

#include "base/vec.h"

namespace roomlight {

// Solid angle of the triangle seen from p, in steradian (Van Oosterom & Strackee 1983).
float triangleSolidAngle(Vec3 p, Vec3 a, Vec3 b, Vec3 c);

class SphericalTriangle {
 public:
  // Corners as seen from p; with the solid angle, where that is known.
  SphericalTriangle(Vec3 p, Vec3 a, Vec3 b, Vec3 c) : SphericalTriangle(p, a, b, c, triangleSolidAngle(p, a, b, c)) {}
  SphericalTriangle(Vec3 p, Vec3 a, Vec3 b, Vec3 c, float solidAngle);
  float solidAngle() const { return solidAngle_; }
  Vec3 sample(Vec2 u) const;  // unit direction from p

 private:
  Vec3 a_, b_, c_;
  float cosAlpha_ = 1, sinAlpha_ = 0, cosC_ = 1;  // alpha: the angle at A
  float solidAngle_ = 0;
};

}  // namespace roomlight
