// How threads are set up that work in parallel loops.
#pragma once

#include <pmmintrin.h>
#include <sys/resource.h>
#include <unistd.h>

namespace roomlight {

// On Linux niceness is a thread's own. Where it cannot be set the thread goes on as before.
inline void giveWay() { setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), 10); }

// Tiny numbers count as zero, as Embree asks, for as long as this lives and in this thread; afterwards as before.
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
