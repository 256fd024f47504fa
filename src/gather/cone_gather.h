// Technique `cone`: pictures from voxel radiance. Primary visibility and direct light by exact rays, diffuse light and
// occlusion by cones through the directional pyramid, reflections by cones or, where they are narrower than voxels,
// rays.
#pragma once

#include "gather/picture.h"
#include "radiance/radiance_field.h"
#include "trace/traced_scene.h"

namespace roomlight {

struct GatherSettings : PictureSettings {
  GatherSettings() { rayRoughness = 0.6f; }
  int conesPerShading = 2;        // diffuse cones
  float coneHalfAngleDeg = 0.3f;
  float startOffsetVoxels = 0.05f;  // along the normal
  float occlusionLambda = 0;      // f(r) = 1 / (1 + lambda r) in ambient occlusion, 1/m
  Vec3 ambientCdM2{0, 0, 0};      // luminance of light that ambient occlusion attenuates; 0: physical light only
};

GatheredPicture gatherCones(const TracedScene& scene, const Voxels& voxels, const RadianceField& field,
                            const Camera& camera, const GatherSettings& settings, const Progress& progress = {});

}  // namespace roomlight
