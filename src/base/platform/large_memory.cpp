#include "base/platform/large_memory.h"

#if defined(__unix__) || defined(__APPLE__)
#include <sys/mman.h>
#endif

#include <new>

namespace roomlight {

constexpr size_t kPage = size_t{2} << 20;  // bytes of a large one

void FreeLarge::operator()(void* memory) const { ::operator delete(memory, std::align_val_t{kPage}); }

LargeFloats largeFloats(size_t count) {
  const size_t bytes = (count * sizeof(float) + kPage - 1) / kPage * kPage;
  void* const memory = ::operator new(bytes, std::align_val_t{kPage});
#ifdef MADV_HUGEPAGE
  madvise(memory, bytes, MADV_HUGEPAGE);  // a wish: small ones do as well
#endif
  return LargeFloats(static_cast<float*>(memory));
}

}  // namespace roomlight
