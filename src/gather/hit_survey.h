// Finds where gathering rays arrive, and lights these places: what the cache of hits and the guide are made of. Photons
// of polished surfaces are sent to where the camera looks.
#pragma once

#include "base/progress.h"
#include "gather/caustic_map.h"
#include "gather/hit_cache.h"
#include "gather/hit_guide.h"
#include "scene/scene.h"

namespace roomlight {

class Lights;
class RayShader;
struct RayGatherSettings;

struct HitSurvey {
  HitCache hits;
  HitGuide guide;
  CausticMap caustics;  // of photons, where there are any: rays leave to them what they stand for
  uint64_t rays = 0;
};

// Of rays from what a camera sees. Where light is kept in layers, so it is in the cells. Without cells if cancelled.
HitSurvey surveyHits(const RayScene& rays, const Lights& lights, const RayShader& shader, const Camera& camera,
                     const RayGatherSettings& settings, const Progress& progress);

}  // namespace roomlight
