// A brick's surfaces that face one way: what they see they have in common.
#pragma once

#include "voxel/voxels.h"

namespace roomlight {

constexpr size_t kBrickSides = 6;
inline int32_t brickSide(size_t brick, int face) { return static_cast<int32_t>(kBrickSides * brick) + face; }

// That of a surface at p with unit normal n; -1: no brick there.
inline int32_t brickSideAt(const Voxels& voxels, Vec3 p, Vec3 n) {
  constexpr float kNudge = 0.05f;  // voxels
  for (const float nudge : {-kNudge, kNudge}) {
    const Int3 v = voxels.voxelOf(p + n * (nudge * voxels.voxelSizeM));
    if (v.x < 0 || v.y < 0 || v.z < 0) continue;
    const int32_t b = voxels.brickAt({v.x / kBrickSize, v.y / kBrickSize, v.z / kBrickSize});
    if (b >= 0) return brickSide(static_cast<size_t>(b), dominantFace(n));
  }
  return -1;
}

}  // namespace roomlight
