// Technique `hybrid`: exact rays decide what every direction sees; the voxels are a cache of the light that leaves what they hit.
#pragma once

#include "gather/picture.h"
#include "radiance/radiance_field.h"

namespace roomlight {

struct RayGatherSettings : PictureSettings {
  RayGatherSettings() { samples = 20, firstSamples = 4, tolerance = 0.03f, raysPerShading = 2, fewestShadings = 1, filterPasses = 6; }
  int estimates = 2;        // per shading, a power of two: each a ray that gathers what surfaces reflect, and one to every kind of light
  float nearVoxels = 2;     // what is hit nearer than this is lit afresh, not read from the cache
  float hitCellM = 0;       // edge of the smallest cells of the cache of hits; 0: chosen by the voxels; below 0: no such cache
  int hitSamples = 6;      // of the light on each cell, at most
};

GatheredPicture gatherRays(const RayScene& rays, const Lights& lights, const Voxels& voxels, const RadianceField& field,
                           const Camera& camera, const RayGatherSettings& settings, const Progress& progress = {});

}  // namespace roomlight
