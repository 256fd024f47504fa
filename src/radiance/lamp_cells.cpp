#include "radiance/lamp_cells.h"

#include <algorithm>
#include <cmath>

namespace roomlight {
namespace {

constexpr double kMargin = 1.001;  // for distances that round to less than they are

}  // namespace

LampCells::LampCells(const Lights& lights, float radius) : edge_(kMargin * static_cast<double>(radius)) {
  for (size_t i = 0; i < lights.lampCount(); ++i) sorted_.emplace_back(cellOf(lights.lamp(i).position), i);
  std::sort(sorted_.begin(), sorted_.end());
}

LampCells::Cell LampCells::cellOf(Vec3 p) const {
  return {std::floor(static_cast<double>(p.x) / edge_), std::floor(static_cast<double>(p.y) / edge_), std::floor(static_cast<double>(p.z) / edge_)};
}

void LampCells::around(const Bounds3& box, std::vector<size_t>& lamps) const {
  lamps.clear();
  if (box.empty()) return;
  const Cell lo = cellOf(box.lo), hi = cellOf(box.hi);
  for (double x = lo[0] - 1; x <= hi[0] + 1; ++x) {
    for (double y = lo[1] - 1; y <= hi[1] + 1; ++y) {
      const Cell last{x, y, hi[2] + 1};
      auto it = std::lower_bound(sorted_.begin(), sorted_.end(), std::pair(Cell{x, y, lo[2] - 1}, size_t{0}));
      for (; it != sorted_.end() && it->first <= last; ++it) lamps.push_back(it->second);
    }
  }
}

}  // namespace roomlight
