// What of technique hybrid fits into a time limit, by trying small pieces first.
#pragma once

#include "engine/voxel_stages.h"
#include "gather/ray_gather.h"
#include "trace/traced_scene.h"

namespace roomlight {

// lightVoxels() after a stage "plan", which lights voxels four times as large. What is wanted follows with as large
// voxels as it takes to leave half of `seconds` to the picture; where that is hardly less, or takes a quarter more time
// than foreseen, the large ones stay.
VoxelLight lightVoxelsWithin(double seconds, const TracedScene& scene, const VoxelSettings& voxel,
                             const RadianceSettings& radiance, Stages& stages);

// How much smaller in width and height a picture is that tells how long one of this size takes: enough pixels to
// outweigh what does not grow with them.
int triedPart(int width, int height);

// A picture of the settings' size, or of as much fewer pixels as it takes to have all of them once within `seconds`.
// Tries a small picture first, which may be the one returned. `gather` as the shader has them.
GatheredPicture gatherWithin(double seconds, const TracedScene& scene, const RayShader& shader, const Camera& camera,
                             RayGatherSettings gather, const Progress& progress);

// A picture of width x height, from one of fewer pixels.
Image enlarged(const Image& image, int width, int height);

}  // namespace roomlight
