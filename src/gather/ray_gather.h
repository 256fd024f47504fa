// Technique `hybrid`: exact rays decide what every direction sees; the voxels are a cache of the light that leaves what they hit.
#pragma once

#include "gather/picture.h"
#include "radiance/radiance_field.h"

namespace roomlight {

struct RayGatherSettings : PictureSettings {
  RayGatherSettings() { samples = 20, firstSamples = 4, tolerance = 0.12f; }
  int gatherRays = 1;       // per shading, for light that surfaces reflect
  int lightSamples = 1;     // per shading, of the sky and of emissive meshes each
  float nearVoxels = 2;     // what is hit nearer than this is lit afresh, not read from the cache
  float rayRoughness = 0.3f;  // reflections below this roughness get a ray of their own
};

GatheredPicture gatherRays(const RayScene& rays, const Lights& lights, const Voxels& voxels, const RadianceField& field,
                           const Camera& camera, const RayGatherSettings& settings, const Progress& progress = {});

}  // namespace roomlight
