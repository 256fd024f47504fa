// What techniques `hybrid` and `cone` have in common: voxels, the light in them, what is told of it all.
#pragma once

#include "engine/stages.h"
#include "gather/picture.h"
#include "radiance/radiance_field.h"
#include "trace/ray_scene.h"
#include "voxel/voxelise.h"

namespace roomlight {

struct VoxelLight {
  Voxels voxels;
  RadianceField field;
};

// Stages "voxelise" and "illuminate".
VoxelLight lightVoxels(const RayScene& rays, const Lights& lights, const VoxelSettings& voxel,
                       const RadianceSettings& radiance, Stages& stages);

// The same, given up once `seconds` are over: then without light (no field.irradianceLux).
VoxelLight lightVoxelsBefore(double seconds, const RayScene& rays, const Lights& lights, const VoxelSettings& voxel,
                             const RadianceSettings& radiance, Stages& stages);

// Sizes of voxels and light, and what was traced.
void tellNumbers(const Voxels& voxels, const RadianceField& field, const GatheredPicture& picture, Stages& stages);

}  // namespace roomlight
