// Tiny numbers count as zero, as Embree asks, for as long as this lives and in this thread; afterwards as before.
#pragma once

#include <pmmintrin.h>

namespace roomlight {

class FlushToZero {
 public:
  FlushToZero() : before_(_mm_getcsr()) { _mm_setcsr(before_ | kBoth); }
  ~FlushToZero() { _mm_setcsr((_mm_getcsr() & ~kBoth) | (before_ & kBoth)); }
  FlushToZero(const FlushToZero&) = delete;
  FlushToZero& operator=(const FlushToZero&) = delete;

 private:
  static constexpr unsigned kBoth = _MM_FLUSH_ZERO_MASK | _MM_DENORMALS_ZERO_MASK;
  unsigned before_;
};

}  // namespace roomlight
