#include "baselines/room_around.h"
#include "baselines/vxgi_shader.h"
#include "engine/technique_settings.h"
#include "engine/techniques.h"

namespace roomlight {

Result<Picture> renderVxgi(const Scene& scene, const Camera& camera, const RenderSettings& settings, Stages& stages) {
  if (settings.layers) return Error{"layers: technique vxgi does not keep lamps apart; use hybrid or path"};
  const Stopwatch watch;
  VxgiSettings use = vxgiStage(settings);
  const RayScene rays = stages.run("bvh", [&](const Progress&) { return RayScene(scene); });
  const Lights lights = stages.run("lights", [&](const Progress&) { return Lights(scene, true); });
  const Bounds3 room = roomAround(rays, camera.worldFromCamera.w);
  const VxgiLight light =
      stages.run("illuminate", [&](const Progress& p) { return lightVxgi(rays, lights, room, use, p); });
  if (stages.cancelled()) return Picture{};
  if (settings.timeLimitS > 0) use.timeLimitS = std::max(1e-3, settings.timeLimitS - watch.seconds());
  GatheredPicture result = stages.run("gather", [&](const Progress& p) {
    return gatherPicture(rays, lights, VxgiShader(rays, lights, light, use), camera, use, p);
  });

  stages.number("voxelSizeM", static_cast<double>(light.map.voxelSizeM(0)));
  stages.number("voxels", static_cast<double>(light.sources));
  stages.number("radianceMiB", static_cast<double>(light.map.bytes()) / 1048576);
  stages.number("bounces", light.bounces);
  stages.number("residual", light.residual);
  stages.number("samples", result.samples);
  stages.number("rays", static_cast<double>(light.rays + result.rays));
  stages.number("cones", static_cast<double>(result.cones));
  return finished(rays, camera, std::move(result.image), {});
}

}  // namespace roomlight
