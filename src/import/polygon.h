// Cuts a polygon into triangles.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/vec.h"

namespace roomlight::importers {

// Corner numbers of the triangles, in the polygon's sense of rotation. Concave polygons are cut by their ears; what is
// left after a great many tries (some thousand corners), or crosses itself, as a fan. Polygons without area give a fan
// too.
std::vector<std::array<uint32_t, 3>> triangulate(std::span<const Vec3> corners);

}  // namespace roomlight::importers
