// Inside this folder readers throw; importGltf and importObj turn it into the one-line error of the contract.
#pragma once

#include <exception>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "base/parallel.h"
#include "base/utf8.h"

namespace roomlight::importers {

struct Failure : std::runtime_error {
  using std::runtime_error::runtime_error;  // "place: what is wrong; what to do"
};

[[noreturn]] inline void fail(std::string_view place, std::string_view what) {
  throw Failure(std::string(place).append(place.empty() ? "" : ": ").append(what));
}

// A parallel loop whose bodies may throw; the failure of the lowest index is the one reported, whatever the threads.
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
