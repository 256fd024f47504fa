// 16-bit floats, rounding to nearest; values beyond the largest half become it, never infinity.
#pragma once

#include <immintrin.h>

#include <algorithm>
#include <cstdint>

namespace roomlight {

inline uint16_t toHalf(float v) { return _cvtss_sh(std::clamp(v, -65504.0f, 65504.0f), 0); }
inline float fromHalf(uint16_t h) { return _cvtsh_ss(h); }
inline __m128 fromHalf4(const uint16_t* h) { return _mm_cvtph_ps(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(h))); }

}  // namespace roomlight
