// How light reaches slots: the points where they receive it, and the slots at which rays arrive.
#pragma once

#include <array>
#include <span>
#include <utility>
#include <vector>

#include "base/progress.h"
#include "base/sampler.h"
#include "radiance/slot_remap.h"
#include "trace/ray_scene.h"
#include "trace/surface_point.h"
#include "voxel/voxels.h"

namespace roomlight {

// First slot of a brick, one past its last.
std::pair<size_t, size_t> slotsOfBrick(const Voxels& voxels, size_t brick);

// On a surface that no slot stands for.
struct HiddenReflection {
  size_t ray;  // index of the ray followed
  Vec3 p, n, left;  // left: share of the light that leaves it
  int64_t slot;  // of a surface before it; -1: none
  const Material* material;
};

// Where the way of a ray ends.
struct Arrival {
  int64_t slot = -1;      // -1: nowhere, or not known to voxels
  Ray ray;                // its last part
  Hit hit;                // on the slot's surface
  float passes = 0;       // share of the light that the surface lets through, which went on instead
  Vec3 left{1, 1, 1};     // share of the light that panes and reflections on the way leave
  bool escaped = false;   // out of the scene
  bool reflected = false; // on surfaces that no slot stands for
};

class SlotPaths {
 public:
  static constexpr uint32_t kPoints = 4;

  // What was known before instances moved, and what of it stays.
  struct Before {
    const SlotPaths& paths;
    const SlotRemap& remap;
  };

  SlotPaths() = default;
  // Of no use once `progress` says stop. Refers to rays and voxels. `strict`: surfaces a little behind a slot's place
  // are none of its, for who lights those by themselves (hidden_light.h); else their light would be lost, and the
  // slot's stands for it. Where bricks are carried from `before`, if given, what was found there stands.
  SlotPaths(const RayScene& rays, const Voxels& voxels, uint64_t seed, const Progress& progress, bool strict = false,
            const Before* before = nullptr);

  // The same scene and voxels, wherever they are now.
  void refer(const RayScene& rays, const Voxels& voxels) { rays_ = &rays, voxels_ = &voxels; }

  // Points that receive a slot's light.
  Vec3 point(size_t slot, size_t k) const { return points_[slot][k % kPoints]; }

  // Number for random numbers, which depends on nothing but the place of the slot in the world: what is traced again
  // after an instance has moved meets the same as before.
  uint32_t key(size_t slot) const { return key_[slot]; }

  // Whether its voxel holds one sheet of surface and nothing else.
  bool isSheet(size_t slot) const { return sheet_[slot] != 0; }

  // Follows rays through panes, with the share that they let through, to the slots that stand for the surfaces met. A
  // surface behind the one its slot stands for (the back of a panel before a wall, the inside of a pipe) has no light
  // of its own in the voxels: there the way goes on by a diffuse reflection, which is added to `hidden`. ends[i]
  // belongs to rays[i].
  void follow(std::span<const Ray> rays, std::span<Sampler> samplers, std::vector<Arrival>& ends,
              std::vector<HiddenReflection>* hidden = nullptr) const;

  // Albedo of the surface where it ends, for the light that does not pass it.
  Vec3 albedo(const Arrival& end) const { return albedoOfTheRest(end.hit, end.passes); }
  size_t bytes() const {
    return points_.size() * (sizeof(points_[0]) + sizeof(uint32_t) + sizeof(uint8_t) + sizeof(float));
  }
  SurfacePlace place(const Arrival& end) const { return placeAt(rays_->scene(), end.hit, end.ray.direction); }

 private:
  class Follower;
  void prepare(size_t brick, uint64_t seed);
  void copyFrom(const SlotPaths& before, size_t firstBefore, size_t brick);
  void nameSlots(size_t brick);
  void probe(size_t first, size_t last, uint64_t seed);
  bool fillsVoxel(const FaceSlot& slot) const { return slot.areaM2 > 0.8f * voxels_->voxelSizeM * voxels_->voxelSizeM; }
  Vec3 lifted(Vec3 p, Vec3 n) const;
  void appendProbes(size_t slot, uint64_t seed, std::vector<Ray>& rays) const;
  Ray between(size_t slot, Vec3 p, Vec3 n) const;
  Vec3 albedoOfTheRest(const Hit& hit, float passes) const;

  const RayScene* rays_ = nullptr;
  const Voxels* voxels_ = nullptr;
  float behind_ = 0;  // voxels: further behind a slot's place surfaces are hidden
  std::vector<uint8_t> clear_;  // per instance: lets light through somewhere
  std::vector<std::array<Vec3, kPoints>> points_;  // per slot, like those below
  std::vector<uint32_t> key_;
  std::vector<uint8_t> sheet_;
  std::vector<float> free_;  // metres above its place that are empty, up to the height of its probes
};

// Rays from slots: where they start, how they are followed, and what their random numbers depend on.
struct SlotSampling {
  const Voxels& voxels;
  const SlotPaths& paths;
  uint64_t seed;
};

}  // namespace roomlight
