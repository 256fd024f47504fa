// The first voxels of a cone's way, where it is no wider than they are: surfaces are met where they really lie.
#pragma once

#include "gather/cone_march.h"
#include "voxel/voxels.h"

namespace roomlight {

// Walks from `origin` along unit `d` through the base voxels up to the distance tEnd and adds what it meets to `light`. A slot
// counts where the ray crosses its plane from the front inside its voxel, so the surface a cone starts from, and walls
// beside it, do not shadow it by the thickness of their voxels.
void marchNear(const Voxels& voxels, const RadianceField& field, Vec3 origin, Vec3 d, float tEnd, float lambda, ConeLight& light);

}  // namespace roomlight
