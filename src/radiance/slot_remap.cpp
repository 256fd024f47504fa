#include "radiance/slot_remap.h"

#include <cstring>
#include <unordered_map>

#include "base/parallel.h"
#include "base/random.h"
#include "radiance/slot_paths.h"
#include "voxel/lattice.h"

namespace roomlight {
namespace {

class Hash {
 public:
  void add(uint64_t v) { state_ = mix64(state_ * 0x9e3779b97f4a7c15ull + v); }
  void add(float a, float b) {
    add(std::bit_cast<uint32_t>(a) | static_cast<uint64_t>(std::bit_cast<uint32_t>(b)) << 32);
  }
  void add(Vec3 v) { add(v.x, v.y), add(std::bit_cast<uint32_t>(v.z)); }
  uint64_t value() const { return state_; }

 private:
  uint64_t state_ = 0;
};

// Of all that light depends on.
uint64_t hashOf(const Voxels& voxels, size_t b) {
  Hash hash;
  hash.add(std::bit_cast<uint32_t>(voxels.voxelSizeM));
  for (const uint64_t word : voxels.bricks[b].occupied) hash.add(word);
  const auto [first, last] = slotsOfBrick(voxels, b);
  for (size_t s = first; s < last; ++s) {
    const FaceSlot& slot = voxels.slots[s];
    hash.add(slot.position), hash.add(slot.normal),
        hash.add(slot.albedo);  // not its emission: emissive meshes are lights
    hash.add(slot.areaM2, slot.opacity), hash.add(slot.instance | static_cast<uint64_t>(slot.face) << 32);
  }
  return hash.value();
}

uint64_t keyOf(Int3 c) {
  constexpr uint64_t kMask = (uint64_t{1} << 21) - 1;
  return (static_cast<uint64_t>(c.x) & kMask) | (static_cast<uint64_t>(c.y) & kMask) << 21 |
         (static_cast<uint64_t>(c.z) & kMask) << 42;
}

}  // namespace

Bounds3 boundsOfBrick(const Voxels& voxels, size_t brick) {
  const Int3 c = voxels.bricks[brick].coord;
  const float edge = voxels.voxelSizeM * kBrickSize;
  const Vec3 lo =
      voxels.origin + Vec3{static_cast<float>(c.x), static_cast<float>(c.y), static_cast<float>(c.z)} * edge;
  return {lo, lo + Vec3(edge)};
}

bool overlap(const Bounds3& a, const Bounds3& b, float margin) {
  for (int k = 0; k < 3; ++k) {
    if (a.lo[k] > b.hi[k] + margin || b.lo[k] > a.hi[k] + margin) return false;
  }
  return true;
}

bool crosses(const Ray& ray, std::span<const Bounds3> boxes, float margin) {
  for (const Bounds3& box : boxes) {
    float t0 = ray.tMin, t1 = ray.tMax;
    for (int k = 0; k < 3; ++k) {
      const float inverse =
          1 / (std::abs(ray.direction[k]) > 1e-12f ? ray.direction[k] : std::copysign(1e-12f, ray.direction[k]));
      const float a = (box.lo[k] - margin - ray.origin[k]) * inverse,
                  b = (box.hi[k] + margin - ray.origin[k]) * inverse;
      t0 = std::max(t0, std::min(a, b)), t1 = std::min(t1, std::max(a, b));
    }
    if (t0 <= t1) return true;
  }
  return false;
}

void inFront(const FaceSlot& slot, std::span<const Bounds3> boxes, float voxelSizeM, std::vector<Bounds3>& out) {
  constexpr float kWithin = 4;  // voxels: from the slot's place to its points, and a voxel's width off a tilted box
  out.clear();
  for (const Bounds3& box : boxes) {
    const Vec3 n = slot.normal,
               farthest{n.x > 0 ? box.hi.x : box.lo.x, n.y > 0 ? box.hi.y : box.lo.y, n.z > 0 ? box.hi.z : box.lo.z};
    if (dot(farthest - slot.position, n) > -kWithin * voxelSizeM) out.push_back(box);
  }
}

bool mayMeetBetween(const Bounds3& from, const Bounds3& to, std::span<const Bounds3> boxes) {
  return std::any_of(boxes.begin(), boxes.end(), [&](const Bounds3& box) {
    float t0 = 0, t1 = 1;
    // The first value, at t = 0, goes by `step` to that at 1; it must not be above `most`.
    const auto clip = [&](float first, float step, float most) {
      const float left = most - first;
      if (step > 0) {
        t1 = std::min(t1, left / step);
      } else if (step < 0) {
        t0 = std::max(t0, left / step);
      } else if (left < 0) {
        t1 = -1;
      }
    };
    for (int k = 0; k < 3; ++k) {
      clip(from.lo[k], to.lo[k] - from.lo[k], box.hi[k]);
      clip(-from.hi[k], from.hi[k] - to.hi[k], -box.lo[k]);
    }
    return t0 <= t1;
  });
}

std::vector<BrickMark> marksOf(const Voxels& voxels) {
  std::vector<BrickMark> marks(voxels.bricks.size());
  const Lattice lattice = latticeOf(voxels);
  parallelFor(marks.size(), 16, [&](size_t b) {
    const auto [first, last] = slotsOfBrick(voxels, b);
    marks[b] = {lattice.brickOf(voxels.bricks[b].coord), hashOf(voxels, b), static_cast<uint32_t>(first),
                static_cast<uint32_t>(last - first)};
  });
  return marks;
}

// Points and neighbours of slots depend on what lies within a voxel of them.
SlotRemap remapSlots(std::span<const BrickMark> before, std::span<const BrickMark> now, const Voxels& voxels,
                     std::span<const Bounds3> changed) {
  std::unordered_map<uint64_t, int32_t> places;
  for (size_t b = 0; b < before.size(); ++b) places[keyOf(before[b].coord)] = static_cast<int32_t>(b);
  SlotRemap out;
  out.oldBrick.assign(now.size(), -1), out.firstOld.assign(now.size(), 0);
  out.newSlot.assign(before.empty() ? 0 : before.back().firstSlot + before.back().slots, SlotRemap::kGone);
  for (size_t b = 0; b < now.size(); ++b) {
    const auto place = places.find(keyOf(now[b].coord));
    if (place == places.end()) continue;
    const BrickMark& old = before[static_cast<size_t>(place->second)];
    const Bounds3 bounds = boundsOfBrick(voxels, b);
    const bool touched = std::any_of(changed.begin(), changed.end(),
                                     [&](const Bounds3& c) { return overlap(bounds, c, 2 * voxels.voxelSizeM); });
    if (touched || old.hash != now[b].hash || old.slots != now[b].slots) continue;
    out.oldBrick[b] = place->second, out.firstOld[b] = old.firstSlot;
    for (uint32_t i = 0; i < old.slots; ++i) out.newSlot[old.firstSlot + i] = now[b].firstSlot + i;
  }
  return out;
}

}  // namespace roomlight
