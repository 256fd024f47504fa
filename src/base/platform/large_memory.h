// Memory of many megabytes that is written as soon as it is there.
#pragma once

#include <cstddef>
#include <memory>

namespace roomlight {

struct FreeLarge {
  void operator()(void* memory) const;
};
using LargeFloats = std::unique_ptr<float[], FreeLarge>;

// Not initialised. In large pages where the system has them: handing out small ones, one at a time as each is first
// written, takes as long as a filter's work on them. Throws std::bad_alloc.
LargeFloats largeFloats(size_t count);

}  // namespace roomlight
