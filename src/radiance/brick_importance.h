// How much the light in each brick of voxels matters to pictures of given cameras: what their gathering rays read gets
// all of its rays, what only sends light there a half, the rest of a home a quarter.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/progress.h"
#include "trace/ray_scene.h"
#include "voxel/voxels.h"

namespace roomlight {

class BrickImportance {
 public:
  BrickImportance() = default;  // all matters alike
  // Follows paths from the cameras (importons, after Peter & Pietrek 1998) and looks where they are reflected. Without
  // cameras all matters alike.
  BrickImportance(const RayScene& rays, const Voxels& voxels, std::span<const Camera> cameras, uint64_t seed,
                  const Progress& progress);

  // Of `most` rays those of a slot in this brick, at least one.
  uint32_t raysOf(size_t brick, uint32_t most) const {
    return halvings_.empty() ? most : (most + (1u << halvings_[brick]) - 1) >> halvings_[brick];
  }

 private:
  std::vector<uint8_t> halvings_;  // per brick, of its rays; empty: none
};

}  // namespace roomlight
