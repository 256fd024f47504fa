// Pictures that converge: a technique's picture, put right by path tracing for as long as there is time.
#pragma once

#include "engine/stages.h"
#include "trace/traced_scene.h"

namespace roomlight {

// Stage "refine": traces paths and blends them with `picture` (filter/blend.h) until `seconds` are over (may be
// infinite), or the estimated mse is below settings.blendUntilMse, or it is cancelled. Where there is no time for two
// passes and the blend, found out by a small picture, `picture` stays as it is. Numbers "pathSamples", "pathRays",
// "estimatedError" (root mean square, relative luminance) and "estimatedMse" (of the encoded picture) go to the
// statistics, the latter two to the caller's progress as well. Whether there are such estimates.
bool refineByPath(const TracedScene& scene, const Camera& camera, const RenderSettings& settings, double seconds,
                  Stages& stages, Image& picture);

}  // namespace roomlight
