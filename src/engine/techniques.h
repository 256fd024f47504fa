// One function a technique; the table in render.cpp names them.
#pragma once

#include "engine/stages.h"

namespace roomlight {

Image renderCone(const Scene& scene, const Camera& camera, const RenderSettings& settings, Stages& stages);
Image renderPath(const Scene& scene, const Camera& camera, const RenderSettings& settings, Stages& stages);

}  // namespace roomlight
