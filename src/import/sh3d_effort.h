// A small file can ask for much work: every window against every wall, every room against every other. What a home asks
// for is counted, and a file that asks for more than any home does is refused before it takes minutes.
#pragma once

#include <cstddef>
#include <string>

#include "import/failure.h"

namespace roomlight::importers::sh3d {

class Effort {
 public:
  // Points that are compared or cut, triangles that are made; throws Failure beyond what some seconds can do.
  void spend(size_t units, const std::string& place) {
    used_ += units;
    if (used_ > kMost)
      fail(place, "the walls, rooms and openings up to here cut each other more often than those of any home");
  }

 private:
  static constexpr size_t kMost = 20'000'000;
  size_t used_ = 0;
};

}  // namespace roomlight::importers::sh3d
