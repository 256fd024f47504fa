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

Vec3 octahedralDirection(Vec2 uv) {
  const float x = 2 * uv.x - 1, y = 2 * uv.y - 1;
  Vec3 d{x, y, 1 - std::abs(x) - std::abs(y)};
  if (d.z < 0) {
    d.x = std::copysign(1 - std::abs(y), x);
    d.y = std::copysign(1 - std::abs(x), y);
  }
  return normalize(d);
}

Vec2 octahedralUv(Vec3 d) {
  const float l1 = std::abs(d.x) + std::abs(d.y) + std::abs(d.z);
  float x = d.x / l1, y = d.y / l1;
  if (d.z < 0) {
    const float ox = x;
    x = std::copysign(1 - std::abs(y), ox);
    y = std::copysign(1 - std::abs(ox), y);
  }
  return {0.5f * x + 0.5f, 0.5f * y + 0.5f};
}

}  // namespace roomlight
