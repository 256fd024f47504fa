#include "radiance/slot_cache.h"

#include "base/parallel.h"
#include "radiance/slot_lookup.h"

namespace roomlight {
namespace {

constexpr float kLift = 0.1f;       // voxels: for places to see one another along a bent surface
constexpr float kOffPlane = 0.35f;  // voxels: beyond, a place belongs to another surface
constexpr float kOpposite = -0.95f; // cosine between the normals of a sheet's two sides

// One sheet and nothing else: no surface in its voxel parts one of its places from another.
bool isSheet(const Voxels& voxels, const SurfaceVoxel& voxel) {
  const int count = std::popcount(static_cast<unsigned>(voxel.faces));
  return count == 1 ||
         (count == 2 && voxels.slots[voxel.firstSlot].face / 2 == voxels.slots[voxel.firstSlot + 1].face / 2 &&
          dot(voxels.slots[voxel.firstSlot].normal, voxels.slots[voxel.firstSlot + 1].normal) < kOpposite);
}

int8_t packed(float v) { return static_cast<int8_t>(std::lround(127 * v)); }

}  // namespace

SlotCache::SlotCache(const Voxels& voxels, const RadianceField& field)
    : voxels_(voxels), perMetre_(1 / voxels.voxelSizeM), records_(voxels.slots.size()) {
  parallelFor(voxels.voxels.size(), 8192, [&](size_t v) {
    const SurfaceVoxel& voxel = voxels.voxels[v];
    const auto count = static_cast<uint32_t>(std::popcount(static_cast<unsigned>(voxel.faces)));
    for (uint32_t i = voxel.firstSlot; i < voxel.firstSlot + count; ++i) {
      const FaceSlot& slot = voxels.slots[i];
      Record& r = records_[i];
      r.radiance = slot.albedo * field.irradianceLux[i] / kPi;
      r.normalX = packed(slot.normal.x), r.normalY = packed(slot.normal.y), r.normalZ = packed(slot.normal.z);
      r.offset = dot(slot.position - voxels.origin, r.normal()) * perMetre_;
      r.alone = isSheet(voxels, voxel);
      r.instance = slot.instance;
    }
  });
}

// The slot that faces n best among those of a voxel.
int64_t SlotCache::slotOf(const SurfaceVoxel& voxel, Vec3 n) const {
  const int64_t exact = voxels_.slotAt(voxel, dominantFace(n));
  if (exact >= 0) return exact;
  int64_t best = -1;
  float bestCos = 0;
  const auto count = static_cast<uint32_t>(std::popcount(static_cast<unsigned>(voxel.faces)));
  for (uint32_t i = voxel.firstSlot; i < voxel.firstSlot + count; ++i) {
    const float c = dot(records_[i].normal(), n);
    if (c > bestCos) bestCos = c, best = i;
  }
  return best;
}

SlotCache::Place SlotCache::find(Vec3 p, Vec3 n) const {
  const Vec3 q = (p - voxels_.origin) * perMetre_;
  const float onPlane = onPlaneM(voxels_.voxelSizeM) * perMetre_;
  const auto offPlane = [&](int64_t slot) {
    const Record& r = records_[static_cast<size_t>(slot)];
    return std::abs(dot(q, r.normal()) - r.offset);
  };
  const SlotFound found = lookAround(q, n, [&](Int3 at) {
    const int64_t voxel = voxels_.voxelAt(at),
                  slot = voxel < 0 ? -1 : slotOf(voxels_.voxels[static_cast<size_t>(voxel)], n);
    return SlotFound{slot, slot >= 0 && offPlane(slot) < onPlane};
  });
  if (found.slot < 0) return {};
  if (found.onPlane && records_[static_cast<size_t>(found.slot)].alone) return {found.slot, Trust::Sure};
  return {found.slot, offPlane(found.slot) > kOffPlane ? Trust::None : Trust::Unsure};
}

void SlotCache::prefetch(std::span<const Vec3> points) const {
  constexpr size_t kAtOnce = 64;
  std::array<Int3, kAtOnce> voxel;
  std::array<int64_t, kAtOnce> at;
  for (; !points.empty(); points = points.subspan(std::min(kAtOnce, points.size()))) {
    const size_t n = std::min(kAtOnce, points.size());
    for (size_t i = 0; i < n; ++i) {
      const Vec3 q = (points[i] - voxels_.origin) * perMetre_;
      voxel[i] = {static_cast<int>(std::floor(q.x)), static_cast<int>(std::floor(q.y)),
                  static_cast<int>(std::floor(q.z))};
      at[i] = voxels_.brickAt({voxel[i].x / kBrickSize, voxel[i].y / kBrickSize, voxel[i].z / kBrickSize});
      if (at[i] >= 0)
        __builtin_prefetch(&voxels_.bricks[static_cast<size_t>(at[i])]),
            __builtin_prefetch(&voxels_.bricks[static_cast<size_t>(at[i])].before);
    }
    for (size_t i = 0; i < n; ++i) {
      if (at[i] >= 0) at[i] = voxels_.voxelAt(voxel[i]);
      if (at[i] >= 0) __builtin_prefetch(&voxels_.voxels[static_cast<size_t>(at[i])]);
    }
    for (size_t i = 0; i < n; ++i) {
      if (at[i] >= 0) __builtin_prefetch(&records_[voxels_.voxels[static_cast<size_t>(at[i])].firstSlot]);
    }
  }
}

Ray SlotCache::between(int64_t slot, Vec3 p, Vec3 n) const {
  const Vec3 lift = n * (kLift * voxels_.voxelSizeM), from = p + lift;
  return {from, voxels_.slots[static_cast<size_t>(slot)].position + lift - from, 0, 1};
}

}  // namespace roomlight
