// Lamps sorted by cubes of space, to find those close to a place without asking all of them.
#pragma once

#include <array>
#include <utility>
#include <vector>

#include "trace/lights.h"

namespace roomlight {

class LampCells {
 public:
  // Cubes are about as large as the radius asked for.
  LampCells(const Lights& lights, float radius);

  // Indices of all lamps closer to the box than the radius, and of some further off.
  void around(const Bounds3& box, std::vector<size_t>& lamps) const;

 private:
  using Cell = std::array<double, 3>;  // whole numbers
  Cell cellOf(Vec3 p) const;

  double edge_;
  std::vector<std::pair<Cell, size_t>> sorted_;
};

}  // namespace roomlight
