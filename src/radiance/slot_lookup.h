// Which slot, and which brick, a point of a surface belongs to. Floors and walls of homes stand on round coordinates,
// as borders of voxels do: rounding puts a point of such a surface to either side, and what is found there may be
// another surface close behind.
#pragma once

#include <algorithm>
#include <cmath>

#include "base/vec.h"
#include "voxel/voxels.h"

namespace roomlight {

// What looking at one voxel found: a slot, -1: none, and whether the point lies on its plane.
struct SlotFound {
  int64_t slot = -1;
  bool onPlane = false;
};

// Looks at the voxel around q, in voxels from the lattice's origin, and at those a little before and behind it along n,
// until one holds a slot on whose plane q lies; else the first slot found. `look` (SlotFound of Int3) is asked.
template <class Look>
SlotFound lookAround(Vec3 q, Vec3 n, Look&& look) {
  constexpr float kRounding = 0.02f, kBeside = 0.3f;
  const auto voxelAround = [](Vec3 at) {
    return Int3{static_cast<int>(std::floor(at.x)), static_cast<int>(std::floor(at.y)),
                static_cast<int>(std::floor(at.z))};
  };
  const Int3 own = voxelAround(q);
  const SlotFound here = look(own);
  if (here.onPlane) return here;
  SlotFound first = here;
  for (const float nudge : {kRounding, -kRounding}) {
    const Int3 voxel = voxelAround(q + n * nudge);
    if (voxel == own) continue;
    const SlotFound found = look(voxel);
    if (found.onPlane) return found;
    if (first.slot < 0) first = found;
  }
  for (const float nudge : {kBeside, -kBeside}) {
    if (first.slot < 0) first = look(voxelAround(q + n * nudge));
  }
  return first;
}

// Metres off a slot's plane within which a point belongs to its own sheet and not to one close behind.
inline float onPlaneM(float voxelSizeM) { return std::min(0.05f * voxelSizeM, 0.005f); }

// Slot of Voxels that a point of a surface belongs to: the face of its voxel nearest to `normal`; -1 where voxels hold
// nothing.
int64_t slotAtSurface(const Voxels& voxels, Vec3 p, Vec3 normal);

// The brick that holds it, or around p where there is no slot; -1: none.
int32_t brickAtSurface(const Voxels& voxels, Vec3 p, Vec3 normal);

// A brick's surfaces that face one way: what they see they have in common.
constexpr size_t kBrickSides = 6;
inline int32_t brickSide(size_t brick, int face) { return static_cast<int32_t>(kBrickSides * brick) + face; }

// That of a surface at p with unit normal n; -1: no brick there.
inline int32_t brickSideAt(const Voxels& voxels, Vec3 p, Vec3 n) {
  const int32_t b = brickAtSurface(voxels, p, n);
  return b < 0 ? -1 : brickSide(static_cast<size_t>(b), dominantFace(n));
}

}  // namespace roomlight
