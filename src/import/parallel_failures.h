// A parallel loop whose bodies may throw; the failure of the lowest index is the one reported, whatever the threads.
#pragma once

#include <exception>
#include <vector>

#include "base/parallel.h"

namespace roomlight::importers {

template <class Body>
void parallelOrFail(size_t count, Body&& body) {
  std::vector<std::exception_ptr> failures(count);
  parallelFor(count, 1, [&](size_t i) {
    try {
      body(i);
    } catch (...) {
      failures[i] = std::current_exception();
    }
  });
  for (const std::exception_ptr& failure : failures) {
    if (failure) std::rethrow_exception(failure);
  }
}

}  // namespace roomlight::importers
