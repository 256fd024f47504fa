#include "base/platform/large_memory.h"

#include <sys/mman.h>

#include <cstdlib>
#include <new>

namespace roomlight {

constexpr size_t kPage = size_t{2} << 20;  // bytes of a large one

void FreeLarge::operator()(void* memory) const { std::free(memory); }

LargeFloats largeFloats(size_t count) {
  const size_t bytes = (count * sizeof(float) + kPage - 1) / kPage * kPage;
  void* const memory = std::aligned_alloc(kPage, bytes);
  if (!memory) throw std::bad_alloc();
#ifdef MADV_HUGEPAGE
  madvise(memory, bytes, MADV_HUGEPAGE);  // a wish: small ones do as well
#endif
  return LargeFloats(static_cast<float*>(memory));
}

}  // namespace roomlight
