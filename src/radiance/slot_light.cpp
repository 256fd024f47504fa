#include "radiance/slot_light.h"

#include <cmath>

#include "base/parallel.h"
#include "base/simd.h"
#include "radiance/slot_paths.h"

namespace roomlight {

SlotLight::SlotLight(const Voxels& voxels, std::span<const Vec3> perSlot) {
  float brightest = 0;
  for (const Vec3& v : perSlot) brightest = std::max(brightest, maxComponent(v));
  if (!(brightest > 0)) return;
  // A power of two, so that what is stored again does not change.
  unit_ = Vec3(std::exp2(std::ceil(std::log2(brightest / 32768))));
  first_.assign(voxels.bricks.size(), kNone);
  size_t count = 0;
  for (size_t b = 0; b < first_.size(); ++b) {
    const auto [first, last] = slotsOfBrick(voxels, b);
    const auto range = perSlot.subspan(first, last - first);
    if (std::all_of(range.begin(), range.end(), [](const Vec3& v) { return isBlack(v); })) continue;
    first_[b] = static_cast<uint32_t>(count);
    count += range.size();
  }
  values_.resize(count);
  parallelFor(first_.size(), 64, [&](size_t b) {
    if (first_[b] == kNone) return;
    const auto [first, last] = slotsOfBrick(voxels, b);
    for (size_t s = first; s < last; ++s) {
      const Vec3 v = perSlot[s] / unit_;
      values_[first_[b] + s - first] = {toHalf(v.x), toHalf(v.y), toHalf(v.z)};
    }
  });
}

void SlotLight::addTo(const Voxels& voxels, Vec3 scale, std::span<Vec3> perSlot) const {
  parallelFor(first_.size(), 64, [&](size_t b) { addBrick(voxels, b, scale, perSlot); });
}

void SlotLight::addBrick(const Voxels& voxels, size_t brick, Vec3 scale, std::span<Vec3> perSlot) const {
  if (!reaches(brick)) return;
  const auto [first, last] = slotsOfBrick(voxels, brick);
  const Vec3 unit = scale * unit_;
  for (size_t s = first; s < last; ++s) {
    const auto& v = values_[first_[brick] + s - first];
    perSlot[s] += Vec3{fromHalf(v[0]), fromHalf(v[1]), fromHalf(v[2])} * unit;
  }
}

void SlotLight::copyBrick(size_t brick, size_t slots, std::span<Vec3> to) const {
  if (!reaches(brick)) return;
  for (size_t i = 0; i < slots; ++i) {
    const auto& v = values_[first_[brick] + i];
    to[i] = Vec3{fromHalf(v[0]), fromHalf(v[1]), fromHalf(v[2])} * unit_;
  }
}

}  // namespace roomlight
