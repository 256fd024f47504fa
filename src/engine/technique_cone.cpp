#include "engine/technique_settings.h"
#include "engine/techniques.h"
#include "engine/voxel_stages.h"

namespace roomlight {

Result<Picture> renderCone(const Scene& scene, const Camera& camera, const RenderSettings& settings, Stages& stages) {
  if (settings.layers) return Error{"layers: technique cone does not keep lamps apart; use hybrid or path"};
  const Stopwatch watch;
  StageSettings<GatherSettings> use = coneStages(settings);

  const RayScene rays = stages.run("bvh", [&](const Progress&) { return RayScene(scene); });
  const Lights lights = stages.run("lights", [&](const Progress&) { return Lights(scene, true); });
  const VoxelLight light = lightVoxels(rays, lights, use.voxel, use.radiance, stages);
  if (stages.cancelled()) return Picture{};
  // What the stages before took counts against the limit; the gather never ends before its first pass.
  if (settings.timeLimitS > 0) use.gather.timeLimitS = std::max(1e-3, settings.timeLimitS - watch.seconds());
  GatheredPicture result = stages.run("gather", [&](const Progress& p) { return gatherCones(rays, lights, light.voxels, light.field, camera, use.gather, p); });

  tellNumbers(light, result, stages);
  stages.number("cones", static_cast<double>(result.cones));
  return finished(rays, camera, std::move(result.image), {});
}

}  // namespace roomlight
