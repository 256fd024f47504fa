// Tiny numbers as zero, in the way that each kind of processor has.
#pragma once

#include <cstdint>
#if defined(__x86_64__)
#include <pmmintrin.h>
#endif

namespace roomlight {

// Tiny numbers count as zero, as Embree asks, for as long as this lives and in this thread; afterwards as before.
class FlushToZero {
 public:
  FlushToZero() : before_(control()) { setControl(before_ | kBoth); }
  ~FlushToZero() { setControl((control() & ~kBoth) | (before_ & kBoth)); }
  FlushToZero(const FlushToZero&) = delete;
  FlushToZero& operator=(const FlushToZero&) = delete;

 private:
#if defined(__x86_64__)
  using Bits = unsigned;
  static constexpr Bits kBoth = _MM_FLUSH_ZERO_MASK | _MM_DENORMALS_ZERO_MASK;  // of results and of operands
  static Bits control() { return _mm_getcsr(); }
  static void setControl(Bits bits) { _mm_setcsr(bits); }
#elif defined(__aarch64__)
  using Bits = uint64_t;
  static constexpr Bits kBoth = 1u << 24;  // FZ of the register FPCR: both results and operands
  static Bits control() {
    Bits bits;
    asm volatile("mrs %0, fpcr" : "=r"(bits));
    return bits;
  }
  static void setControl(Bits bits) { asm volatile("msr fpcr, %0" : : "r"(bits)); }
#else
  using Bits = unsigned;
  static constexpr Bits kBoth = 0;
  static Bits control() { return 0; }
  static void setControl(Bits) {}
#endif

  Bits before_;
};

}  // namespace roomlight
