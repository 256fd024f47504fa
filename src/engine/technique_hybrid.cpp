#include "engine/light_colour.h"
#include "engine/refine.h"
#include "engine/techniques.h"

namespace roomlight {

Picture renderHybrid(const Scene& scene, const Camera& camera, const RenderSettings& settings, Stages& stages) {
  const Stopwatch watch;
  RadianceSettings radiance = settings.radiance;
  radiance.seed = settings.seed;
  radiance.pyramid = false;
  RayGatherSettings gather = settings.hybrid;
  gather.width = settings.width;
  gather.height = settings.height;
  gather.seed = settings.seed;
  if (settings.samples > 0) gather.samples = settings.samples;

  const RayScene rays = stages.run("bvh", [&](const Progress&) { return RayScene(scene); });
  const Lights lights = stages.run("lights", [&](const Progress&) { return Lights(scene, true); });
  const Voxels voxels = stages.run("voxelise", [&](const Progress&) { return voxelise(scene, settings.voxel).voxels; });
  const RadianceField field = stages.run("illuminate", [&](const Progress& p) { return illuminate(rays, lights, voxels, radiance, p); });
  if (stages.cancelled()) return {};
  // What the stages before took counts against the limit; the gather never ends before its first pass.
  if (settings.timeLimitS > 0) gather.timeLimitS = std::max(1e-3, settings.timeLimitS - watch.seconds());
  GatheredPicture result = stages.run("gather", [&](const Progress& p) { return gatherRays(rays, lights, voxels, field, camera, gather, p); });

  stages.number("voxelSizeM", static_cast<double>(voxels.voxelSizeM));
  stages.number("voxels", static_cast<double>(voxels.voxels.size()));
  stages.number("slots", static_cast<double>(voxels.slots.size()));
  stages.number("voxelMiB", static_cast<double>(voxels.bytes()) / 1048576);
  stages.number("radianceMiB", static_cast<double>(field.bytes()) / 1048576);
  stages.number("bounces", field.bounces);
  stages.number("residual", field.residual);
  stages.number("samples", result.samples);
  stages.number("rays", static_cast<double>(field.rays + result.rays));
  const double left = settings.timeLimitS - watch.seconds();
  if (settings.blend && left > 0 && !stages.cancelled()) refineByPath(rays, lights, camera, settings, left, stages, result.image);
  const Vec3 colour = lightColour(rays, camera, result.image);
  return {std::move(result.image), colour};
}

}  // namespace roomlight
