// Small vectors, a rigid-or-affine transform and bounds. All plain structs of float; lengths in metres unless a name
// says otherwise. Transforms are named right to left: worldFromObject maps object coordinates to world coordinates.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace roomlight {

constexpr float kPi = 3.14159265358979323846f;
constexpr float kInfinity = std::numeric_limits<float>::infinity();

struct Vec2 {
  float x = 0, y = 0;
};

inline Vec2 operator+(Vec2 a, Vec2 b) { return {a.x + b.x, a.y + b.y}; }
inline Vec2 operator-(Vec2 a, Vec2 b) { return {a.x - b.x, a.y - b.y}; }
inline Vec2 operator*(Vec2 a, float s) { return {a.x * s, a.y * s}; }
inline Vec2 operator*(float s, Vec2 a) { return a * s; }

struct Vec3 {
  float x = 0, y = 0, z = 0;
  Vec3() = default;
  constexpr Vec3(float xx, float yy, float zz) : x(xx), y(yy), z(zz) {}
  explicit constexpr Vec3(float s) : x(s), y(s), z(s) {}
  float& operator[](int i) { return (&x)[i]; }
  float operator[](int i) const { return (&x)[i]; }
};

inline Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec3 operator-(Vec3 a) { return {-a.x, -a.y, -a.z}; }
inline Vec3 operator*(Vec3 a, Vec3 b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
inline Vec3 operator*(Vec3 a, float s) { return {a.x * s, a.y * s, a.z * s}; }
inline Vec3 operator*(float s, Vec3 a) { return a * s; }
inline Vec3 operator/(Vec3 a, float s) { return a * (1.0f / s); }
inline Vec3 operator/(Vec3 a, Vec3 b) { return {a.x / b.x, a.y / b.y, a.z / b.z}; }
inline Vec3& operator+=(Vec3& a, Vec3 b) { return a = a + b; }
inline Vec3& operator-=(Vec3& a, Vec3 b) { return a = a - b; }
inline Vec3& operator*=(Vec3& a, Vec3 b) { return a = a * b; }
inline Vec3& operator*=(Vec3& a, float s) { return a = a * s; }
inline bool operator==(Vec3 a, Vec3 b) { return a.x == b.x && a.y == b.y && a.z == b.z; }

inline float dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec3 cross(Vec3 a, Vec3 b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
inline float lengthSquared(Vec3 a) { return dot(a, a); }
inline float length(Vec3 a) { return std::sqrt(dot(a, a)); }
inline Vec3 normalize(Vec3 a) { return a / length(a); }
inline Vec3 min(Vec3 a, Vec3 b) { return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)}; }
inline Vec3 max(Vec3 a, Vec3 b) { return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)}; }
inline Vec3 abs(Vec3 a) { return {std::abs(a.x), std::abs(a.y), std::abs(a.z)}; }
inline float maxComponent(Vec3 a) { return std::max(a.x, std::max(a.y, a.z)); }
inline float minComponent(Vec3 a) { return std::min(a.x, std::min(a.y, a.z)); }
inline bool isFinite(Vec3 a) { return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z); }
inline bool isBlack(Vec3 a) { return a.x == 0 && a.y == 0 && a.z == 0; }
template <class T>
T lerp(T a, T b, float t) {
  return a * (1 - t) + b * t;
}

// Luminance of linear Rec.709 RGB in the unit of its components (ITU-R BT.709).
inline float luminance(Vec3 rgb) { return 0.2126f * rgb.x + 0.7152f * rgb.y + 0.0722f * rgb.z; }

// Two unit vectors that form a right-handed frame with the unit vector n (Duff et al. 2017).
struct Frame {
  Vec3 t, b, n;
  explicit Frame(Vec3 normal) : n(normal) {
    const float sign = std::copysign(1.0f, n.z);
    const float a = -1.0f / (sign + n.z);
    const float c = n.x * n.y * a;
    t = {1.0f + sign * n.x * n.x * a, sign * c, -sign * n.x};
    b = {c, sign + n.y * n.y * a, -n.y};
  }
  Vec3 toWorld(Vec3 v) const { return t * v.x + b * v.y + n * v.z; }
  Vec3 toLocal(Vec3 v) const { return {dot(v, t), dot(v, b), dot(v, n)}; }
};

// Affine map: columns x, y, z and translation w.
struct Affine {
  Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1}, w{0, 0, 0};
  Vec3 point(Vec3 p) const { return x * p.x + y * p.y + z * p.z + w; }
  Vec3 vector(Vec3 v) const { return x * v.x + y * v.y + z * v.z; }
  // Direction of the transformed surface normal, not normalised: cofactor matrix times v (right for mirrors too,
  // up to the sign of the determinant).
  Vec3 normal(Vec3 v) const { return cross(y, z) * v.x + cross(z, x) * v.y + cross(x, y) * v.z; }
  float determinant() const { return dot(x, cross(y, z)); }
  bool operator==(const Affine&) const = default;
};

inline Affine operator*(const Affine& a, const Affine& b) {
  return {a.vector(b.x), a.vector(b.y), a.vector(b.z), a.point(b.w)};
}

// Inverse of an affine map with non-zero determinant.
inline Affine inverse(const Affine& a) {
  const float d = 1.0f / a.determinant();
  const Vec3 r0 = cross(a.y, a.z) * d, r1 = cross(a.z, a.x) * d, r2 = cross(a.x, a.y) * d;
  Affine r{{r0.x, r1.x, r2.x}, {r0.y, r1.y, r2.y}, {r0.z, r1.z, r2.z}, {}};
  r.w = -r.vector(a.w);
  return r;
}

struct Bounds3 {
  Vec3 lo{kInfinity, kInfinity, kInfinity}, hi{-kInfinity, -kInfinity, -kInfinity};
  void add(Vec3 p) { lo = min(lo, p), hi = max(hi, p); }
  void add(const Bounds3& b) { lo = min(lo, b.lo), hi = max(hi, b.hi); }
  bool empty() const { return !(lo.x <= hi.x); }
  Vec3 size() const { return hi - lo; }
  Vec3 centre() const { return (lo + hi) * 0.5f; }
};

}  // namespace roomlight
