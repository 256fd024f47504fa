// How light reaches slots: the points where they receive it, and the slots at which rays arrive.
#pragma once

#include <array>
#include <utility>
#include <vector>

#include "base/progress.h"
#include "base/sampler.h"
#include "trace/ray_scene.h"
#include "voxel/voxels.h"

namespace roomlight {

// On a surface that no slot stands for. `left`: share of the light that leaves it.
struct HiddenReflection {
  Vec3 p, n, left;
  int64_t slot;  // of a surface before it; -1: none
};

// Where the way of a ray ends.
struct Arrival {
  int64_t slot = -1;      // -1: nowhere, or not known to voxels
  Vec3 p, n;              // on the slot's surface
  Hit hit;                // there
  float passes = 0;       // share of the light that the surface lets through, which went on instead
  Vec3 left{1, 1, 1};     // share of the light that panes and reflections on the way leave
  bool escaped = false;   // out of the scene
  bool reflected = false; // on surfaces that no slot stands for
};

class SlotPaths {
 public:
  static constexpr uint32_t kPoints = 4;

  // Of no use once `progress` says stop.
  SlotPaths(const RayScene& rays, const Voxels& voxels, uint64_t seed, const Progress& progress);

  // Points that receive a slot's light.
  Vec3 point(size_t slot, size_t k) const { return points_[slot][k % kPoints]; }

  // Goes on from a ray's first hit, through panes with the share that they let through, to the slot that stands for the surface
  // met. A surface behind the one its slot stands for (the back of a panel before a wall, the inside of a pipe) has no light of
  // its own in the voxels: there the way goes on by a diffuse reflection, which is added to `hidden`.
  Arrival follow(Ray ray, Hit hit, Sampler& sampler, std::vector<HiddenReflection>* hidden = nullptr) const;

  // Albedo of the surface where it ends, for the light that does not pass it.
  Vec3 albedo(const Arrival& end) const { return albedoOfTheRest(end.hit, end.passes); }

  std::pair<size_t, size_t> slotsOfBrick(size_t brick) const;  // first, one past the last

 private:
  void place(size_t brick);
  Vec3 albedoOfTheRest(const Hit& hit, float passes) const;
  bool fillsVoxel(const FaceSlot& slot) const;
  Vec3 lifted(Vec3 p, Vec3 n) const;
  bool facesAlong(const Hit& hit, Vec3 n) const;
  void appendProbes(size_t slot, std::vector<Ray>& rays) const;
  bool connected(size_t slot, Vec3 p, Vec3 n) const;
  bool isHidden(size_t slot, Vec3 p, Vec3 n) const;

  const RayScene& rays_;
  const Voxels& voxels_;
  const uint64_t seed_;
  std::vector<std::array<Vec3, kPoints>> points_;  // per slot
  std::vector<float> free_;  // per slot: metres above its place that are empty, up to the height of its probes
};

}  // namespace roomlight
