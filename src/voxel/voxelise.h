// Scene -> Voxels: conservative rasterisation with exact clipped areas, brick by brick in parallel, and updates that
// redo only the bricks a moved instance left or entered.
#pragma once

#include <compare>
#include <span>
#include <vector>

#include "scene/scene.h"
#include "scene/scene_change.h"
#include "voxel/voxels.h"

namespace roomlight {

struct VoxelSettings {
  float voxelSizeM = 0;        // 0: chosen from the budget
  float sizeFactor = 1;        // times the size so chosen
  float memoryBudgetMiB = 128; // for Voxels when the size is chosen; a size given by hand may exceed it
  float smallestM = 0.05f;     // limits of the automatic choice
  float largestM = 0.5f;
};

// Edge length that is expected to keep Voxels and the light on them within the budget; settings.voxelSizeM where given.
float chooseVoxelSize(const Scene& scene, const VoxelSettings& settings);

// A voxelised scene that can be kept up to date.
struct Voxelisation {
  Voxels voxels;
  float wantedM = 0;  // size of voxels, but where the scene's extent is absurd for it
  // Which triangles touch which brick: per brick (same order as voxels.bricks) a range of references, in order of
  // (instance, triangle), so that a brick done again gives bit-identical records.
  struct Reference {
    uint32_t instance, triangle;
    auto operator<=>(const Reference&) const = default;
  };
  std::vector<uint32_t> firstReference;  // bricks + 1
  std::vector<Reference> references;
  std::vector<Bounds3> instanceBounds;  // world; empty where hidden
};

// Cost: proportional to triangles plus voxels touched. `hidden[i]` true leaves instance i out; empty means none is
// hidden. Where the scene's extent is absurd for the voxel size (see feasibleVoxelSizeM in lattice.h), the voxels come
// out larger.
Voxelisation voxelise(const Scene& scene, const VoxelSettings& settings, std::span<const uint8_t> hidden = {});

// Brings `v` up to date after the listed instances of `scene` changed (transform, or hidden: `hidden[i]` true removes
// instance i; empty means none is hidden); new instances at the end of `scene` count as changed. Same result, bit for
// bit, as voxelise() of the scene as it is now with the voxel size that v had at first, also where the grid grows or
// shrinks. Cost: the bricks that changed instances left and entered, plus a copy of the rest.
void update(Voxelisation& v, const Scene& scene, std::span<const uint32_t> changedInstances,
            std::span<const uint8_t> hidden = {});

// Brings the voxels up to date and returns the boxes outside which the change
// left the scene as it was: one an object, or two where it went far.
std::vector<Bounds3> followMoves(Voxelisation& voxels, const Scene& scene, const SceneChange& change);

}  // namespace roomlight
