// Which slot, and which brick, a point of a surface belongs to. Floors and walls of homes stand on round coordinates, as borders of voxels do: rounding puts a point of such a surface to either
// side, and what is found there may be another surface close behind.
#pragma once

#include "base/vec.h"
#include "voxel/voxels.h"

namespace roomlight {

// What looking at one voxel found: a slot, -1: none, and how far off its plane the point lies, in voxels.
struct SlotFound {
  int64_t slot = -1;
  float off = kInfinity;
};

// Looks at the voxel around q, in voxels from the lattice's origin, and at those a little before and behind it along n: the slot on whose plane q lies, or to which it lies nearest.
// `look` (SlotFound of Int3) is asked.
template <class Look>
SlotFound lookAround(Vec3 q, Vec3 n, Look&& look) {
  constexpr float kRounding = 0.02f, kBeside = 0.3f, kSamePlane = 0.002f;
  const auto voxelAround = [](Vec3 at) { return Int3{static_cast<int>(std::floor(at.x)), static_cast<int>(std::floor(at.y)), static_cast<int>(std::floor(at.z))}; };
  const Int3 own = voxelAround(q);
  SlotFound best = look(own);
  for (const float nudge : {kRounding, -kRounding}) {
    if (best.off < kSamePlane) return best;
    const Int3 voxel = voxelAround(q + n * nudge);
    if (voxel == own) continue;
    if (const SlotFound found = look(voxel); found.off < best.off) best = found;
  }
  for (const float nudge : {kBeside, -kBeside}) {
    if (best.slot < 0) best = look(voxelAround(q + n * nudge));
  }
  return best;
}

constexpr float kOnPlane = 0.05f;  // voxels: within, a point belongs to the slot's own sheet and not to one close behind

// Slot of Voxels that a point of a surface belongs to: the face of its voxel nearest to `normal`; -1 where voxels hold nothing.
int64_t slotAtSurface(const Voxels& voxels, Vec3 p, Vec3 normal);

// The brick that holds it, or around p where there is no slot; -1: none.
int32_t brickAtSurface(const Voxels& voxels, Vec3 p, Vec3 normal);

}  // namespace roomlight
