// Cuts a polygon into triangles.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/vec.h"

namespace roomlight::importers {

// How much cutting by ears all polygons of a file may take: for each the square of its corners at least.
struct EarBudget {
  size_t testsLeft = size_t{1} << 28;  // of corners against ears
  size_t fans = 0;                     // polygons that found nothing left
};

// Corner numbers of the triangles, in the polygon's sense of rotation. Concave polygons are cut by their ears; what is
// left after a great many tries (some thousand corners), or crosses itself, as a fan. Polygons without area give a fan
// too, and those for which nothing of the budget is left.
std::vector<std::array<uint32_t, 3>> triangulate(std::span<const Vec3> corners, EarBudget& budget);
inline std::vector<std::array<uint32_t, 3>> triangulate(std::span<const Vec3> corners) {
  EarBudget budget;
  return triangulate(corners, budget);
}

}  // namespace roomlight::importers
