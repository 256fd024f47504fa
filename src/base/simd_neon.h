// simd.h for arm64; included by that alone. The same values as on x86-64 bit for bit, NaN in min() and max() included.
#pragma once

#include <arm_neon.h>

#include "base/simd.h"

namespace roomlight {

struct Float4 {
  Float4() : v(vdupq_n_f32(0)) {}
  explicit Float4(float32x4_t lanes) : v(lanes) {}
  explicit Float4(uint32x4_t bits) : v(vreinterpretq_f32_u32(bits)) {}
  explicit Float4(float all) : v(vdupq_n_f32(all)) {}
  Float4(float x, float y, float z, float w) : v{x, y, z, w} {}
  static Float4 load(const float* from) { return Float4(vld1q_f32(from)); }
  void store(float* to) const { vst1q_f32(to, v); }
  float x() const { return vgetq_lane_f32(v, 0); }
  Float4 everyW() const { return Float4(vdupq_laneq_f32(v, 3)); }
  uint32x4_t bits() const { return vreinterpretq_u32_f32(v); }

  float32x4_t v;
};

inline Float4 operator+(Float4 a, Float4 b) { return Float4(vaddq_f32(a.v, b.v)); }
inline Float4 operator-(Float4 a, Float4 b) { return Float4(vsubq_f32(a.v, b.v)); }
inline Float4 operator*(Float4 a, Float4 b) { return Float4(vmulq_f32(a.v, b.v)); }
inline Float4 operator/(Float4 a, Float4 b) { return Float4(vdivq_f32(a.v, b.v)); }
inline Float4 operator&(Float4 a, Float4 b) { return Float4(vandq_u32(a.bits(), b.bits())); }
inline Float4 operator|(Float4 a, Float4 b) { return Float4(vorrq_u32(a.bits(), b.bits())); }
// As on x86-64 the second where either is a NaN, which vminq and vmaxq are not.
inline Float4 min(Float4 a, Float4 b) { return Float4(vbslq_f32(vcltq_f32(a.v, b.v), a.v, b.v)); }
inline Float4 max(Float4 a, Float4 b) { return Float4(vbslq_f32(vcgtq_f32(a.v, b.v), a.v, b.v)); }
inline Float4 sqrt(Float4 a) { return Float4(vsqrtq_f32(a.v)); }
// Lanes of `yes` where every bit of `which` is set, of `no` where none is.
inline Float4 select(Float4 which, Float4 yes, Float4 no) { return Float4(vbslq_f32(which.bits(), yes.v, no.v)); }
// Comparisons set every bit of the lanes where they hold; never of a NaN.
inline Float4 operator<(Float4 a, Float4 b) { return Float4(vcltq_f32(a.v, b.v)); }
inline Float4 operator<=(Float4 a, Float4 b) { return Float4(vcleq_f32(a.v, b.v)); }
// The top bit of each lane, x lowest.
inline unsigned topBits(Float4 a) {
  const int32x4_t places{0, 1, 2, 3};
  return vaddvq_u32(vshlq_u32(vshrq_n_u32(a.bits(), 31), places));
}

// a b + c
inline Float4 fma(Float4 a, Float4 b, Float4 c) { return Float4(vfmaq_f32(c.v, a.v, b.v)); }

// (a.x b.x + a.y b.y) + (a.z b.z + a.w b.w)
inline float dot(Float4 a, Float4 b) {
  const float32x4_t products = vmulq_f32(a.v, b.v);
  return vpadds_f32(vget_low_f32(vpaddq_f32(products, products)));
}

// Four 16-bit floats.
inline Float4 fromHalf4(const uint16_t* from) { return Float4(vcvt_f32_f16(vreinterpret_f16_u16(vld1_u16(from)))); }

// Rounded to nearest; what is beyond the largest becomes infinite.
inline void toHalf4(Float4 a, uint16_t* to) { vst1_u16(to, vreinterpret_u16_f16(vcvt_f16_f32(a.v))); }

}  // namespace roomlight

#include "base/simd_pairs.h"

namespace roomlight {

inline Float8 fromBytes(const int8_t* from) {
  const int16x8_t words = vmovl_s8(vld1_s8(from));
  return {Float4(vcvtq_f32_s32(vmovl_s16(vget_low_s16(words)))),
          Float4(vcvtq_f32_s32(vmovl_s16(vget_high_s16(words))))};
}
inline Float8 fromBytes(const uint8_t* from) {
  const uint16x8_t words = vmovl_u8(vld1_u8(from));
  return {Float4(vcvtq_f32_u32(vmovl_u16(vget_low_u16(words)))),
          Float4(vcvtq_f32_u32(vmovl_u16(vget_high_u16(words))))};
}
// The 24 bits after the sign of floats that are not negative.
inline Float8 fromTopBits(const uint16_t* high16, const uint8_t* low8) {
  const uint16x8_t h = vld1q_u16(high16), l = vmovl_u8(vld1_u8(low8));
  return {Float4(vorrq_u32(vshll_n_u16(vget_low_u16(h), 15), vshll_n_u16(vget_low_u16(l), 7))),
          Float4(vorrq_u32(vshll_n_u16(vget_high_u16(h), 15), vshll_n_u16(vget_high_u16(l), 7)))};
}

}  // namespace roomlight
