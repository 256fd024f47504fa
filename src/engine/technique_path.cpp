#include "base/split.h"
#include "engine/layers.h"
#include "engine/technique_settings.h"
#include "engine/techniques.h"

namespace roomlight {

Result<Picture> renderPath(const Scene& scene, const Camera& camera, const RenderSettings& settings, Stages& stages) {
  const RayScene rays = stages.run("bvh", [&](const Progress&) { return RayScene(scene); });
  const Lights lights = stages.run("lights", [&](const Progress&) { return Lights(scene); });
  const auto layers = wantedLayers(scene, lights, settings);
  if (!layers) return Error{layers.error()};
  PathSettings path = pathStage(settings);
  path.layers = layers.value();
  PathResult result = stages.run("path", [&](const Progress& p) { return pathTrace(rays, lights, camera, path, p); });
  splitLike(result.image, result.layers);
  stages.number("samples", result.samples);
  stages.number("noise", std::isfinite(result.noise) ? result.noise : -1);
  stages.number("rays", static_cast<double>(result.rays));
  return finished(rays, camera, std::move(result.image), described(layers.value().get(), std::move(result.layers)));
}

}  // namespace roomlight
