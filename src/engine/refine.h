// Pictures that converge: a technique's picture, put right by path tracing for as long as there is time.
#pragma once

#include "engine/stages.h"
#include "trace/lights.h"
#include "trace/ray_scene.h"

namespace roomlight {

// Stage "refine": traces paths for `seconds`, or until cancelled, and blends them with `picture` (filter/blend.h). Before two passes
// are done the picture stays as it is. Numbers "pathSamples", "pathRays", "estimatedError" (root mean square, relative luminance) and
// "estimatedMse" (of the encoded picture) go to the statistics.
void refineByPath(const RayScene& rays, const Lights& lights, const Camera& camera, const RenderSettings& settings, double seconds, Stages& stages, Image& picture);

}  // namespace roomlight
