// simd.h for x86-64; included by that alone.
#pragma once

#include <immintrin.h>

#include "base/simd.h"

namespace roomlight {

struct Float4 {
  Float4() : v(_mm_setzero_ps()) {}
  explicit Float4(__m128 lanes) : v(lanes) {}
  explicit Float4(float all) : v(_mm_set1_ps(all)) {}
  Float4(float x, float y, float z, float w) : v(_mm_setr_ps(x, y, z, w)) {}
  static Float4 load(const float* from) { return Float4(_mm_loadu_ps(from)); }
  void store(float* to) const { _mm_storeu_ps(to, v); }
  float x() const { return _mm_cvtss_f32(v); }
  Float4 everyW() const { return Float4(_mm_shuffle_ps(v, v, 0xff)); }

  __m128 v;
};

inline Float4 operator+(Float4 a, Float4 b) { return Float4(_mm_add_ps(a.v, b.v)); }
inline Float4 operator-(Float4 a, Float4 b) { return Float4(_mm_sub_ps(a.v, b.v)); }
inline Float4 operator*(Float4 a, Float4 b) { return Float4(_mm_mul_ps(a.v, b.v)); }
inline Float4 operator/(Float4 a, Float4 b) { return Float4(_mm_div_ps(a.v, b.v)); }
inline Float4 operator&(Float4 a, Float4 b) { return Float4(_mm_and_ps(a.v, b.v)); }
inline Float4 min(Float4 a, Float4 b) { return Float4(_mm_min_ps(a.v, b.v)); }
inline Float4 max(Float4 a, Float4 b) { return Float4(_mm_max_ps(a.v, b.v)); }
inline Float4 sqrt(Float4 a) { return Float4(_mm_sqrt_ps(a.v)); }
inline Float4 operator|(Float4 a, Float4 b) { return Float4(_mm_or_ps(a.v, b.v)); }
// Lanes of `yes` where every bit of `which` is set, of `no` where none is.
inline Float4 select(Float4 which, Float4 yes, Float4 no) {
  return Float4(_mm_or_ps(_mm_and_ps(which.v, yes.v), _mm_andnot_ps(which.v, no.v)));
}
// Comparisons set every bit of the lanes where they hold; never of a NaN.
inline Float4 operator<(Float4 a, Float4 b) { return Float4(_mm_cmplt_ps(a.v, b.v)); }
inline Float4 operator<=(Float4 a, Float4 b) { return Float4(_mm_cmple_ps(a.v, b.v)); }
// The top bit of each lane, x lowest.
inline unsigned topBits(Float4 a) { return static_cast<unsigned>(_mm_movemask_ps(a.v)); }

// a b + c
inline Float4 fma(Float4 a, Float4 b, Float4 c) {
#ifdef __FMA__
  return Float4(_mm_fmadd_ps(a.v, b.v, c.v));
#else
  return a * b + c;
#endif
}

// (a.x b.x + a.y b.y) + (a.z b.z + a.w b.w)
inline float dot(Float4 a, Float4 b) {
#ifdef __SSE4_1__
  return _mm_cvtss_f32(_mm_dp_ps(a.v, b.v, 0xf1));
#else
  const __m128 products = _mm_mul_ps(a.v, b.v);
  const __m128 pairs = _mm_add_ps(products, _mm_shuffle_ps(products, products, 0xb1));
  return _mm_cvtss_f32(_mm_add_ss(pairs, _mm_movehl_ps(pairs, pairs)));
#endif
}

// Four 16-bit floats.
inline Float4 fromHalf4(const uint16_t* from) {
#ifdef __F16C__
  return Float4(_mm_cvtph_ps(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(from))));
#else
  return {fromHalf(from[0]), fromHalf(from[1]), fromHalf(from[2]), fromHalf(from[3])};
#endif
}

// Rounded to nearest; what is beyond the largest becomes infinite.
inline void toHalf4(Float4 a, uint16_t* to) {
#ifdef __F16C__
  _mm_storel_epi64(reinterpret_cast<__m128i*>(to), _mm_cvtps_ph(a.v, _MM_FROUND_TO_NEAREST_INT));
#else
  float lanes[4];
  a.store(lanes);
  for (int i = 0; i < 4; ++i) to[i] = imath_float_to_half(lanes[i]);
#endif
}

#if defined(__AVX2__) && defined(__FMA__) && defined(__F16C__)

struct Float8 {
  Float8() : v(_mm256_setzero_ps()) {}
  explicit Float8(__m256 lanes) : v(lanes) {}
  explicit Float8(float all) : v(_mm256_set1_ps(all)) {}
  static Float8 load(const float* from) { return Float8(_mm256_loadu_ps(from)); }
  void store(float* to) const { _mm256_storeu_ps(to, v); }
  Float4 low() const { return Float4(_mm256_castps256_ps128(v)); }
  Float4 high() const { return Float4(_mm256_extractf128_ps(v, 1)); }

  __m256 v;
};

inline Float8 operator+(Float8 a, Float8 b) { return Float8(_mm256_add_ps(a.v, b.v)); }
inline Float8 operator-(Float8 a, Float8 b) { return Float8(_mm256_sub_ps(a.v, b.v)); }
inline Float8 operator*(Float8 a, Float8 b) { return Float8(_mm256_mul_ps(a.v, b.v)); }
inline Float8 operator/(Float8 a, Float8 b) { return Float8(_mm256_div_ps(a.v, b.v)); }
inline Float8 operator&(Float8 a, Float8 b) { return Float8(_mm256_and_ps(a.v, b.v)); }
inline Float8 operator<(Float8 a, Float8 b) { return Float8(_mm256_cmp_ps(a.v, b.v, _CMP_LT_OQ)); }
inline Float8 operator<=(Float8 a, Float8 b) { return Float8(_mm256_cmp_ps(a.v, b.v, _CMP_LE_OQ)); }
inline Float8 min(Float8 a, Float8 b) { return Float8(_mm256_min_ps(a.v, b.v)); }
inline Float8 max(Float8 a, Float8 b) { return Float8(_mm256_max_ps(a.v, b.v)); }
inline Float8 fma(Float8 a, Float8 b, Float8 c) { return Float8(_mm256_fmadd_ps(a.v, b.v, c.v)); }
inline unsigned topBits(Float8 a) { return static_cast<unsigned>(_mm256_movemask_ps(a.v)); }

inline Float8 fromHalf8(const uint16_t* from) {
  return Float8(_mm256_cvtph_ps(_mm_loadu_si128(reinterpret_cast<const __m128i*>(from))));
}
inline void toHalf8(Float8 a, uint16_t* to) {
  _mm_storeu_si128(reinterpret_cast<__m128i*>(to), _mm256_cvtps_ph(a.v, _MM_FROUND_TO_NEAREST_INT));
}
inline Float8 fromBytes(const int8_t* from) {
  return Float8(_mm256_cvtepi32_ps(_mm256_cvtepi8_epi32(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(from)))));
}
inline Float8 fromBytes(const uint8_t* from) {
  return Float8(_mm256_cvtepi32_ps(_mm256_cvtepu8_epi32(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(from)))));
}
// The 24 bits after the sign of floats that are not negative.
inline Float8 fromTopBits(const uint16_t* high16, const uint8_t* low8) {
  const __m256i h = _mm256_cvtepu16_epi32(_mm_loadu_si128(reinterpret_cast<const __m128i*>(high16)));
  const __m256i l = _mm256_cvtepu8_epi32(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(low8)));
  return Float8(_mm256_castsi256_ps(_mm256_or_si256(_mm256_slli_epi32(h, 15), _mm256_slli_epi32(l, 7))));
}

#else

}  // namespace roomlight

#include "base/simd_pairs.h"

namespace roomlight {

inline Float8 fromBytes(const int8_t* from) {
  const __m128i bytes = _mm_loadl_epi64(reinterpret_cast<const __m128i*>(from)),
                words = _mm_unpacklo_epi8(bytes, bytes);
  return {Float4(_mm_cvtepi32_ps(_mm_srai_epi32(_mm_unpacklo_epi16(words, words), 24))),
          Float4(_mm_cvtepi32_ps(_mm_srai_epi32(_mm_unpackhi_epi16(words, words), 24)))};
}
inline Float8 fromBytes(const uint8_t* from) {
  const __m128i zero = _mm_setzero_si128(),
                words = _mm_unpacklo_epi8(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(from)), zero);
  return {Float4(_mm_cvtepi32_ps(_mm_unpacklo_epi16(words, zero))),
          Float4(_mm_cvtepi32_ps(_mm_unpackhi_epi16(words, zero)))};
}
// The 24 bits after the sign of floats that are not negative.
inline Float8 fromTopBits(const uint16_t* high16, const uint8_t* low8) {
  const __m128i zero = _mm_setzero_si128(), h = _mm_loadu_si128(reinterpret_cast<const __m128i*>(high16));
  const __m128i l = _mm_unpacklo_epi8(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(low8)), zero);
  const auto joined = [](__m128i high, __m128i low) {
    return Float4(_mm_castsi128_ps(_mm_or_si128(_mm_slli_epi32(high, 15), _mm_slli_epi32(low, 7))));
  };
  return {joined(_mm_unpacklo_epi16(h, zero), _mm_unpacklo_epi16(l, zero)),
          joined(_mm_unpackhi_epi16(h, zero), _mm_unpackhi_epi16(l, zero))};
}

#endif

}  // namespace roomlight
