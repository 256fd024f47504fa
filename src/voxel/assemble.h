// Puts bricks together into the flat arrays of a Voxelisation.
#pragma once

#include <span>

#include "voxel/brick_builder.h"
#include "voxel/lattice.h"

namespace roomlight {

// A brick's records wherever they lie: freshly built, or in an older Voxelisation.
struct BrickView {
  uint32_t place = 0;                // in the dense index of the lattice it goes to
  std::array<uint64_t, 8> occupied{};
  std::span<const SurfaceVoxel> voxels;
  std::span<const FaceSlot> slots;
  uint32_t slotBase = 0;             // what the voxels' firstSlot counts from
  std::span<const Voxelisation::Reference> references;
};

BrickView viewOf(const BrickRecords& records, uint32_t place, std::span<const Voxelisation::Reference> references);
BrickView viewOf(const Voxelisation& v, size_t brick, uint32_t place);

// Bricks in ascending order of place. Fills all but `instanceBounds`.
Voxelisation assemble(const Lattice& lattice, std::span<const BrickView> bricks);

}  // namespace roomlight
