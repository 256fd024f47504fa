// One function a technique; the table in render.cpp names them.
#pragma once

#include "engine/sights.h"
#include "engine/stages.h"

namespace roomlight {

struct Picture {
  Image image;       // linear, cd/m²; empty if cancelled before there was one
  Vec3 lightColour;  // see light_colour.h
  Sights sights;
  std::vector<RenderedLayer> layers;
};
// With what is seen in it.
Picture finished(const RayScene& rays, const Camera& camera, Image image, std::vector<RenderedLayer> layers);

Result<Picture> renderHybrid(const Scene& scene, const Camera& camera, const RenderSettings& settings, Stages& stages);
Result<Picture> renderCone(const Scene& scene, const Camera& camera, const RenderSettings& settings, Stages& stages);
Result<Picture> renderVxgi(const Scene& scene, const Camera& camera, const RenderSettings& settings, Stages& stages);
Result<Picture> renderLpv(const Scene& scene, const Camera& camera, const RenderSettings& settings, Stages& stages);
Result<Picture> renderPhoton(const Scene& scene, const Camera& camera, const RenderSettings& settings, Stages& stages);
Result<Picture> renderPath(const Scene& scene, const Camera& camera, const RenderSettings& settings, Stages& stages);

}  // namespace roomlight
