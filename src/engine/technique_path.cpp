#include "engine/technique_settings.h"
#include "engine/techniques.h"

namespace roomlight {

Picture renderPath(const Scene& scene, const Camera& camera, const RenderSettings& settings, Stages& stages) {
  const RayScene rays = stages.run("bvh", [&](const Progress&) { return RayScene(scene); });
  const Lights lights = stages.run("lights", [&](const Progress&) { return Lights(scene); });
  PathResult result = stages.run("path", [&](const Progress& p) { return pathTrace(rays, lights, camera, pathStage(settings), p); });
  stages.number("samples", result.samples);
  stages.number("noise", std::isfinite(result.noise) ? result.noise : -1);
  stages.number("rays", static_cast<double>(result.rays));
  return finished(rays, camera, std::move(result.image));
}

}  // namespace roomlight
