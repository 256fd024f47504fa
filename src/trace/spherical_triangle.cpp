#include "trace/spherical_triangle.h"

namespace roomlight {
float triangleSolidAngle(Vec3 p, Vec3 a, Vec3 b, Vec3 c) {
  const Vec3 x = a - p, y = b - p, z = c - p;
  const float lx = length(x), ly = length(y), lz = length(z);
  const float numerator = std::abs(dot(x, cross(y, z)));
  const float denominator = lx * ly * lz + dot(x, y) * lz + dot(x, z) * ly + dot(y, z) * lx;
  const float half = std::atan2(numerator, denominator);
  return 2 * (half < 0 ? half + kPi : half);
}

SphericalTriangle::SphericalTriangle(Vec3 p, Vec3 a, Vec3 b, Vec3 c, float solidAngle)
    : a_(normalize(a - p)), b_(normalize(b - p)), c_(normalize(c - p)), solidAngle_(solidAngle) {
  // The angle between the planes of the arcs AB and AC.
  const Vec3 ab = cross(a_, b_), ac = cross(a_, c_);
  const float l = std::sqrt(lengthSquared(ab) * lengthSquared(ac));
  if (l > 0)
    cosAlpha_ = std::clamp(dot(ab, ac) / l, -1.0f, 1.0f), sinAlpha_ = std::min(1.0f, length(cross(ab, ac)) / l);
  cosC_ = dot(a_, b_);
}

Vec3 SphericalTriangle::sample(Vec2 u) const {
  // The sub-triangle with vertex on arc AC and area u.x * solidAngle; then a point on the arc from B to that vertex.
  // The sampled area plus pi is the sum of the sub-triangle's angles; the corner at C' follows.
  const float area = u.x * solidAngle_;
  // Sine and cosine of that area less the angle at A.
  const float sinArea = std::sin(area), cosArea = std::cos(area);
  const float s = sinArea * cosAlpha_ - cosArea * sinAlpha_, t = cosArea * cosAlpha_ + sinArea * sinAlpha_;
  const float uu = t - cosAlpha_;
  const float vv = s + sinAlpha_ * cosC_;
  const float denominator = (vv * s + uu * t) * sinAlpha_;
  float q = denominator != 0 ? ((vv * t - uu * s) * cosAlpha_ - vv) / denominator : 1;
  q = std::clamp(q, -1.0f, 1.0f);
  const Vec3 orthogonal = c_ - a_ * dot(c_, a_);
  const float lo = length(orthogonal);
  const Vec3 cPrime = lo > 0 ? a_ * q + orthogonal * (std::sqrt(std::max(0.0f, 1 - q * q)) / lo) : a_;
  const float z = 1 - u.y * (1 - dot(cPrime, b_));
  const Vec3 across = cPrime - b_ * dot(cPrime, b_);
  const float la = length(across);
  return la > 0 ? normalize(b_ * z + across * (std::sqrt(std::max(0.0f, 1 - z * z)) / la)) : b_;
}

}  // namespace roomlight
