// Eight floats as twice four, for processors that have no more at once; included after Float4 is.
#pragma once

namespace roomlight {

struct Float8 {
  Float8() = default;
  Float8(Float4 low, Float4 high) : a(low), b(high) {}
  explicit Float8(float all) : a(all), b(all) {}
  static Float8 load(const float* from) { return {Float4::load(from), Float4::load(from + 4)}; }
  void store(float* to) const { a.store(to), b.store(to + 4); }
  Float4 low() const { return a; }
  Float4 high() const { return b; }

  Float4 a, b;
};

inline Float8 operator+(Float8 a, Float8 b) { return {a.a + b.a, a.b + b.b}; }
inline Float8 operator-(Float8 a, Float8 b) { return {a.a - b.a, a.b - b.b}; }
inline Float8 operator*(Float8 a, Float8 b) { return {a.a * b.a, a.b * b.b}; }
inline Float8 operator/(Float8 a, Float8 b) { return {a.a / b.a, a.b / b.b}; }
inline Float8 operator&(Float8 a, Float8 b) { return {a.a & b.a, a.b & b.b}; }
inline Float8 operator<(Float8 a, Float8 b) { return {a.a < b.a, a.b < b.b}; }
inline Float8 operator<=(Float8 a, Float8 b) { return {a.a <= b.a, a.b <= b.b}; }
inline Float8 min(Float8 a, Float8 b) { return {min(a.a, b.a), min(a.b, b.b)}; }
inline Float8 max(Float8 a, Float8 b) { return {max(a.a, b.a), max(a.b, b.b)}; }
inline Float8 fma(Float8 a, Float8 b, Float8 c) { return {fma(a.a, b.a, c.a), fma(a.b, b.b, c.b)}; }
inline unsigned topBits(Float8 a) { return topBits(a.a) | topBits(a.b) << 4; }

inline Float8 fromHalf8(const uint16_t* from) { return {fromHalf4(from), fromHalf4(from + 4)}; }
inline void toHalf8(Float8 a, uint16_t* to) { toHalf4(a.a, to), toHalf4(a.b, to + 4); }

}  // namespace roomlight
