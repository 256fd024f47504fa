// Four and eight floats at once. All vector instructions of the program but the filter's are here and in the files for
// each kind of processor that this one takes. On x86-64 with AVX2, FMA and F16C (x86-64-v3) a function is one or two of
// them, without it does the same in SSE2, which every x86-64 has; fma() then rounds twice. On arm64 eight are twice
// four. Loads and stores need no alignment. Also single numbers as half floats.
#pragma once

#define IMATH_HALF_NO_LOOKUP_TABLE  // by arithmetic, which needs neither 256 KiB of cache nor the library
#include <Imath/half.h>

#include <algorithm>
#include <cstdint>

namespace roomlight {

// 16-bit floats, rounding to nearest; values beyond the largest half become it, never infinity.
inline uint16_t toHalf(float v) { return imath_float_to_half(std::clamp(v, -65504.0f, 65504.0f)); }

inline float fromHalf(uint16_t h) { return imath_half_to_float(h); }

}  // namespace roomlight

#if defined(__aarch64__)
#include "base/simd_neon.h"
#else
#include "base/simd_x86.h"
#endif
