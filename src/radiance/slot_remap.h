// What of the slots stays when instances have moved: bricks with the same records as before, away from what moved.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "trace/ray_scene.h"
#include "voxel/voxels.h"

namespace roomlight {

// Tells a brick's records from others, wherever they stand in the arrays.
struct BrickMark {
  Int3 coord;  // in bricks from the world's origin
  uint64_t hash = 0;
  uint32_t firstSlot = 0, slots = 0;
};
std::vector<BrickMark> marksOf(const Voxels& voxels);

struct SlotRemap {
  static constexpr uint32_t kGone = 0xffffffffu;
  std::vector<int32_t> oldBrick;   // per brick; -1: new, changed, or close to a change
  std::vector<uint32_t> newSlot;   // per old slot; kGone where its brick is not carried
  std::vector<uint32_t> firstOld;  // per brick: its first slot before, where carried
  bool keeps(size_t brick) const { return oldBrick[brick] >= 0; }
};

// What is known of a change: what stays, and where instances that moved were and are, m.
struct SlotChange {
  const SlotRemap& remap;
  std::span<const Bounds3> places;
};

// `changed`: where instances are and were, m.
SlotRemap remapSlots(std::span<const BrickMark> before, std::span<const BrickMark> now, const Voxels& voxels,
                     std::span<const Bounds3> changed);

Bounds3 boundsOfBrick(const Voxels& voxels, size_t brick);
// Whether a segment (tMin, tMax of the ray) comes closer than `margin` to one of the boxes.
bool crosses(const Ray& ray, std::span<const Bounds3> boxes, float margin);
bool overlap(const Bounds3& a, const Bounds3& b, float margin);
// Those of `boxes` that rays from a slot's points, which all leave to its outside, may come closer to than a voxel.
void inFront(const FaceSlot& slot, std::span<const Bounds3> boxes, float voxelSizeM, std::vector<Bounds3>& out);
// Whether a straight way from somewhere in one box to somewhere in the other may meet one of `boxes`. Exact for the
// convex hull of the two: the union of all boxes between them, whose middles and sizes go linearly from one to the
// other.
bool mayMeetBetween(const Bounds3& from, const Bounds3& to, std::span<const Bounds3> boxes);

}  // namespace roomlight
