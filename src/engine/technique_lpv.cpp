#include "baselines/lpv_shader.h"
#include "baselines/room_around.h"
#include "engine/technique_settings.h"
#include "engine/techniques.h"

namespace roomlight {

Result<Picture> renderLpv(const Scene& scene, const Camera& camera, const RenderSettings& settings, Stages& stages) {
  if (settings.layers) return Error{"layers: technique lpv does not keep lamps apart; use hybrid or path"};
  const Stopwatch watch;
  LpvSettings use = lpvStage(settings);
  const RayScene rays = stages.run("bvh", [&](const Progress&) { return RayScene(scene); });
  const Lights lights = stages.run("lights", [&](const Progress&) { return Lights(scene, true); });
  const Bounds3 room = roomAround(rays, camera.worldFromCamera.w);
  const LpvLight light =
      stages.run("illuminate", [&](const Progress& p) { return lightLpv(rays, lights, room, use, p); });
  if (stages.cancelled()) return Picture{};
  if (settings.timeLimitS > 0) use.timeLimitS = std::max(1e-3, settings.timeLimitS - watch.seconds());
  GatheredPicture result = stages.run("gather", [&](const Progress& p) {
    return gatherPicture(rays, lights, LpvShader(rays, lights, light, use), camera, use, p);
  });

  size_t bytes = 0;
  for (const LpvLevel& level : light.levels) bytes += level.bytes();
  stages.number("cellM", static_cast<double>(light.levels.front().lattice().cellM));
  stages.number("coarseCellM", static_cast<double>(light.levels.back().lattice().cellM));
  stages.number("virtualLights", static_cast<double>(light.virtualLights));
  stages.number("surfels", static_cast<double>(light.surfels));
  stages.number("radianceMiB", static_cast<double>(bytes) / 1048576);
  stages.number("samples", result.samples);
  stages.number("rays", static_cast<double>(light.rays + result.rays));
  return finished(rays, camera, std::move(result.image), {});
}

}  // namespace roomlight
