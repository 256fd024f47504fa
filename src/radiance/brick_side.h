// A brick's surfaces that face one way: what they see they have in common.
#pragma once

#include "radiance/slot_lookup.h"

namespace roomlight {

constexpr size_t kBrickSides = 6;
inline int32_t brickSide(size_t brick, int face) { return static_cast<int32_t>(kBrickSides * brick) + face; }

// That of a surface at p with unit normal n; -1: no brick there.
inline int32_t brickSideAt(const Voxels& voxels, Vec3 p, Vec3 n) {
  const int32_t b = brickAtSurface(voxels, p, n);
  return b < 0 ? -1 : brickSide(static_cast<size_t>(b), dominantFace(n));
}

}  // namespace roomlight
