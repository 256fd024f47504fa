// Technique `cone`: pictures from voxel radiance. Primary visibility and direct light by exact rays, diffuse light and
// occlusion by cones through the directional pyramid, reflections by cones or, where they are narrower than voxels, rays.
#pragma once

#include "base/image.h"
#include "radiance/radiance_field.h"
#include "scene/scene.h"

namespace roomlight {

struct GatherSettings {
  int width = 960, height = 540;
  int samples = 8;                // camera rays a pixel
  int raysPerShading = 2;         // camera rays that see one surface and share its light: cones, shadow rays, a reflection
  int conesPerShading = 2;        // diffuse cones
  float coneHalfAngleDeg = 0.3f;
  float startOffsetVoxels = 0.05f;  // along the normal
  float rayRoughness = 0.6f;      // reflections below this roughness follow exact rays
  float occlusionLambda = 0;      // f(r) = 1 / (1 + lambda r) in ambient occlusion, 1/m
  Vec3 ambientCdM2{0, 0, 0};      // luminance of light that ambient occlusion attenuates; 0: physical light only
  int filterPasses = 5;           // of the filter that removes remaining noise (filter.h); 0: none
  double timeLimitS = 0;          // stop after a whole pass
  uint64_t seed = 0;
};

struct ConeResult {
  Image image;        // linear, cd/m²
  Image occlusion;    // mean ambient occlusion, 0 open to 1 closed, in every channel
  int samples = 0;
  uint64_t rays = 0, cones = 0;
};

ConeResult gatherCones(const RayScene& rays, const Lights& lights, const Voxels& voxels, const RadianceField& field,
                       const Camera& camera, const GatherSettings& settings, const Progress& progress = {});

}  // namespace roomlight
