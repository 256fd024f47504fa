// New vertices of a mesh, with all that its vertices have.
#pragma once

#include <cstdint>

#include "scene/scene.h"

namespace roomlight {

// Each adds one and returns its number.
uint32_t repeatVertex(Mesh& mesh, uint32_t vertex);
// On the straight line between two, `share` (0 to 1) of the way from the first: interpolated as a hit there would be.
uint32_t addVertexBetween(Mesh& mesh, uint32_t from, uint32_t to, float share);

}  // namespace roomlight
