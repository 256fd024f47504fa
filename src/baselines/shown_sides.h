// Which sides of voxels' surfaces are ones that their materials show.
#pragma once

#include <cstdint>
#include <vector>

#include "trace/ray_scene.h"
#include "voxel/voxels.h"

namespace roomlight {

bool isDoubleSided(const Scene& scene, const FaceSlot& slot);
// Whether a slot shows the front of its triangles.
bool isFront(const RayScene& rays, const FaceSlot& slot, float voxelSizeM);
// Per slot: both sides of double-sided materials, else the front.
std::vector<uint8_t> shownSides(const RayScene& rays, const Voxels& voxels);

}  // namespace roomlight
