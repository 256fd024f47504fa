// Which triangles reach into which brick.
#pragma once

#include <span>
#include <vector>

#include "voxel/lattice.h"
#include "voxel/voxelise.h"

namespace roomlight {

struct BrickReference {
  uint32_t place;  // of the brick in the dense index
  Voxelisation::Reference triangle;
};

// All references of the listed instances (in ascending order), sorted by brick, within a brick by instance and
// triangle. Cost: triangles plus bricks they touch plus places in the dense index.
std::vector<BrickReference> referencesOf(const Scene& scene, const Lattice& lattice,
                                         std::span<const uint32_t> instances);

}  // namespace roomlight
