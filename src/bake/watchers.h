// Which eyes see what is near a place.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/vec.h"

namespace roomlight::bake {

class Watchers {
 public:
  // Of one hit: the cell that it is in, and the number of the eye.
  struct Sighting {
    uint64_t cell = 0;
    uint32_t eye = 0;
    auto operator<=>(const Sighting&) const = default;
  };
  static uint64_t cellOf(Vec3 p);

  explicit Watchers(std::vector<Sighting> sightings);
  // Eyes that saw something in the place's cell: the first of them by number, and others evenly chosen; 24 at most.
  std::span<const uint32_t> of(Vec3 p) const;

 private:
  struct Cell {
    uint64_t key;
    size_t first, count;
  };
  std::vector<Cell> cells_;  // sorted by key
  std::vector<uint32_t> eyes_;
};

}  // namespace roomlight::bake
