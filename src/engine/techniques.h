// One function a technique; the table in render.cpp names them.
#pragma once

#include "engine/stages.h"

namespace roomlight {

struct Picture {
  Image image;       // linear, cd/m²; empty if cancelled before there was one
  Vec3 lightColour;  // see light_colour.h
};
Picture renderHybrid(const Scene& scene, const Camera& camera, const RenderSettings& settings, Stages& stages);
Picture renderCone(const Scene& scene, const Camera& camera, const RenderSettings& settings, Stages& stages);
Picture renderPhoton(const Scene& scene, const Camera& camera, const RenderSettings& settings, Stages& stages);
Picture renderPath(const Scene& scene, const Camera& camera, const RenderSettings& settings, Stages& stages);

}  // namespace roomlight
