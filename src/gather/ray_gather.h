// Technique `hybrid`: exact rays decide what every direction sees; the voxels are a cache of the light that leaves what they hit.
#pragma once

#include "gather/picture.h"
#include "radiance/radiance_field.h"

namespace roomlight {

struct RayGatherSettings : PictureSettings {
  RayGatherSettings() { samples = 20, firstSamples = 4, tolerance = 0.12f, raysPerShading = 2, fewestShadings = 1; }
  int estimates = 2;        // per shading, a power of two: each a ray that gathers what surfaces reflect, and one to every kind of light
  float nearVoxels = 2;     // what is hit nearer than this is lit afresh, not read from the cache
};

GatheredPicture gatherRays(const RayScene& rays, const Lights& lights, const Voxels& voxels, const RadianceField& field,
                           const Camera& camera, const RayGatherSettings& settings, const Progress& progress = {});

}  // namespace roomlight
