// Which sides of voxels' surfaces are ones that their materials show.
#pragma once

#include <cstdint>
#include <vector>

#include "trace/ray_scene.h"
#include "voxel/voxels.h"

namespace roomlight {

// Per slot: both sides of double-sided materials, else the front.
std::vector<uint8_t> shownSides(const RayScene& rays, const Voxels& voxels);

}  // namespace roomlight
