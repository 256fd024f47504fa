// What each technique makes of a scene; the table in render.cpp names them.
#pragma once

#include <functional>

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

// Makes the picture of any camera. What pictures of one scene share is found with the first and kept.
using PictureOf = std::function<Result<Picture>(const Camera& camera, Stages& stages)>;

// Refer to scene and settings.
PictureOf picturesByRays(const Scene& scene, const RenderSettings& settings);
PictureOf picturesByCones(const Scene& scene, const RenderSettings& settings);

// Techniques whose work begins at the camera: all of it for one picture.
Result<Picture> renderVxgi(const Scene& scene, const Camera& camera, const RenderSettings& settings, Stages& stages);
Result<Picture> renderLpv(const Scene& scene, const Camera& camera, const RenderSettings& settings, Stages& stages);
Result<Picture> renderPhoton(const Scene& scene, const Camera& camera, const RenderSettings& settings, Stages& stages);
Result<Picture> renderPath(const Scene& scene, const Camera& camera, const RenderSettings& settings, Stages& stages);

}  // namespace roomlight
