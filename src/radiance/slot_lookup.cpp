#include "radiance/radiance_field.h"

namespace roomlight {
namespace {

// The slot that faces `normal` best among those of one voxel.
int64_t bestSlot(const Voxels& voxels, const SurfaceVoxel& voxel, Vec3 normal) {
  const int64_t exact = voxels.slotAt(voxel, dominantFace(normal));
  if (exact >= 0) return exact;
  int64_t best = -1;
  float bestCos = 0;
  const int count = std::popcount(static_cast<unsigned>(voxel.faces));
  for (int i = 0; i < count; ++i) {
    const float c = dot(voxels.slots[voxel.firstSlot + static_cast<size_t>(i)].normal, normal);
    if (c > bestCos) bestCos = c, best = voxel.firstSlot + i;
  }
  return best;
}

}  // namespace

int64_t slotAtSurface(const Voxels& voxels, Vec3 p, Vec3 normal) {
  // Rounding may put a point of a surface into the neighbouring voxel: look a little to both sides as well.
  const float nudges[] = {0, 0.02f, -0.02f, 0.3f, -0.3f};
  for (const float nudge : nudges) {
    const int64_t record = voxels.voxelAt(voxels.voxelOf(p + normal * (nudge * voxels.voxelSizeM)));
    if (record < 0) continue;
    const int64_t slot = bestSlot(voxels, voxels.voxels[static_cast<size_t>(record)], normal);
    if (slot >= 0) return slot;
  }
  return -1;
}

}  // namespace roomlight
