// How much of the plane through a slot, inside its voxel, is really surface.
#pragma once

#include <cstdint>
#include <vector>

#include "voxel/voxels.h"

namespace roomlight {

// Per slot, 0..255: the slot's area over the area that its plane (position, normal) cuts out of its voxel. A ray that
// crosses the plane inside the voxel meets surface with this probability.
std::vector<uint8_t> slotCoverage(const Voxels& voxels);

// Area that the plane n . x = offset cuts out of the unit cube; n unit.
double planeAreaInUnitCube(Vec3 n, double offset);

}  // namespace roomlight
