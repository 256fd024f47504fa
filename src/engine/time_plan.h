// Voxels and their light, all of it or as much as fits into a time limit, and paths for the time that is left.
#pragma once

#include "engine/stages.h"
#include "gather/picture.h"
#include "gather/ray_gather.h"
#include "radiance/radiance_field.h"
#include "trace/ray_scene.h"
#include "trace/traced_scene.h"
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

// What of technique hybrid fits into a time limit, by trying small pieces first. lightVoxels() after a stage "plan",
// which lights voxels four times as large. What is wanted follows with as large voxels as it takes to leave half of
// `seconds` to the picture; where that is hardly less, or takes a quarter more time than foreseen, the large ones stay.
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

// Pictures that converge: a technique's picture, put right by path tracing for as long as there is time. Stage
// "refine": traces paths and blends them with `picture` (filter/blend.h) until `seconds` are over (may be infinite), or
// the estimated mse is below settings.blendUntilMse, or it is cancelled. Where there is no time for two passes and the
// blend, found out by a small picture, `picture` stays as it is. Numbers "pathSamples", "pathRays", "estimatedError"
// (root mean square, relative luminance) and "estimatedMse" (of the encoded picture) go to the statistics, the latter
// two to the caller's progress as well. Whether there are such estimates.
bool refineByPath(const TracedScene& scene, const Camera& camera, const RenderSettings& settings, double seconds,
                  Stages& stages, Image& picture);

}  // namespace roomlight
