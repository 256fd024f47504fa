#include "radiance/slot_cache.h"

#include "base/parallel.h"

namespace roomlight {
namespace {

constexpr float kLift = 0.1f;       // voxels: for places to see one another along a bent surface
constexpr float kOffPlane = 0.35f;  // voxels: beyond, a place belongs to another surface

}  // namespace

SlotCache::SlotCache(const Voxels& voxels, const RadianceField& field) : voxels_(voxels), radiance_(voxels.slots.size()) {
  parallelFor(radiance_.size(), 16384, [&](size_t i) { radiance_[i] = voxels.slots[i].albedo * field.irradianceLux[i] / kPi; });
}

SlotCache::Place SlotCache::find(Vec3 p, Vec3 n) const {
  const int64_t slot = slotAtSurface(voxels_, p, n);
  if (slot < 0) return {};
  const FaceSlot& f = voxels_.slots[static_cast<size_t>(slot)];
  if (std::abs(dot(f.position - p, f.normal)) > kOffPlane * voxels_.voxelSizeM) return {slot, Trust::None};
  const int64_t record = voxels_.voxelAt(voxels_.voxelOf(p));
  const bool alone = record >= 0 && std::popcount(static_cast<unsigned>(voxels_.voxels[static_cast<size_t>(record)].faces)) == 1;
  return {slot, alone ? Trust::Sure : Trust::Unsure};
}

Ray SlotCache::between(int64_t slot, Vec3 p, Vec3 n) const {
  const Vec3 from = p + n * (kLift * voxels_.voxelSizeM), to = voxels_.slots[static_cast<size_t>(slot)].position + n * (kLift * voxels_.voxelSizeM);
  return {from, to - from, 0, 1};
}

}  // namespace roomlight
