// Technique `photon`: pictures and meter readings by photon mapping (Jensen 1996, 2001).
#pragma once

#include "baselines/photon_light.h"
#include "scene/scene.h"
#include "trace/meter.h"

namespace roomlight {

// What a camera sees, or what falls on elements.
ImportonStart importonsFrom(const Camera& camera, int width, int height);
ImportonStart importonsFrom(std::span<const SurfaceElement> elements);

GatheredPicture gatherPhotons(const RayScene& rays, const Lights& lights, const PhotonLight& light,
                              const Camera& camera, const PhotonSettings& settings, const Progress& progress = {});

}  // namespace roomlight
