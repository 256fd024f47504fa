// 16-bit floats, rounding to nearest; values beyond the largest half become it, never infinity.
#pragma once

#include <algorithm>

#include "base/simd.h"

namespace roomlight {

inline uint16_t toHalf(float v) {
  const float bounded = std::clamp(v, -65504.0f, 65504.0f);
#ifdef __F16C__
  return _cvtss_sh(bounded, _MM_FROUND_TO_NEAREST_INT);
#else
  return static_cast<uint16_t>(_mm_cvtsi128_si32(simd::toHalf(_mm_set_ss(bounded))));
#endif
}

inline float fromHalf(uint16_t h) {
#ifdef __F16C__
  return _cvtsh_ss(h);
#else
  return _mm_cvtss_f32(simd::fromHalf(_mm_cvtsi32_si128(h)));
#endif
}

}  // namespace roomlight
