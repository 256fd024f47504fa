#include "radiance/slot_lookup.h"

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

SlotFound slotIn(const Voxels& voxels, Int3 voxel, Vec3 p, Vec3 normal) {
  const int64_t record = voxels.voxelAt(voxel);
  const int64_t slot = record < 0 ? -1 : bestSlot(voxels, voxels.voxels[static_cast<size_t>(record)], normal);
  if (slot < 0) return {};
  const FaceSlot& found = voxels.slots[static_cast<size_t>(slot)];
  return {slot, std::abs(dot(p - found.position, found.normal)) < onPlaneM(voxels.voxelSizeM)};
}

}  // namespace

int64_t slotAtSurface(const Voxels& voxels, Vec3 p, Vec3 normal) {
  return lookAround((p - voxels.origin) / voxels.voxelSizeM, normal,
                    [&](Int3 at) { return slotIn(voxels, at, p, normal); })
      .slot;
}

int32_t brickAtSurface(const Voxels& voxels, Vec3 p, Vec3 normal) {
  const auto brickAround = [&](Int3 v) {
    return v.x < 0 || v.y < 0 || v.z < 0 ? -1 : voxels.brickAt({v.x / kBrickSize, v.y / kBrickSize, v.z / kBrickSize});
  };
  int32_t brick = -1;
  const auto look = [&](Int3 at) {
    const SlotFound found = slotIn(voxels, at, p, normal);
    if (found.onPlane || (found.slot >= 0 && brick < 0)) brick = brickAround(at);
    return found;
  };
  lookAround((p - voxels.origin) / voxels.voxelSizeM, normal, look);
  return brick < 0 ? brickAround(voxels.voxelOf(p)) : brick;
}

}  // namespace roomlight
