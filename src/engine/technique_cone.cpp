#include "engine/light_colour.h"
#include "engine/techniques.h"

namespace roomlight {

Picture renderCone(const Scene& scene, const Camera& camera, const RenderSettings& settings, Stages& stages) {
  const Stopwatch watch;
  RadianceSettings radiance = settings.radiance;
  radiance.seed = settings.seed;
  GatherSettings gather = settings.gather;
  gather.width = settings.width;
  gather.height = settings.height;
  gather.seed = settings.seed;
  if (settings.samples > 0) gather.samples = settings.samples;

  const RayScene rays = stages.run("bvh", [&](const Progress&) { return RayScene(scene); });
  const Lights lights = stages.run("lights", [&](const Progress&) { return Lights(scene, true); });
  const Voxelisation voxelisation = stages.run("voxelise", [&](const Progress&) { return voxelise(scene, settings.voxel); });
  const Voxels& voxels = voxelisation.voxels;
  const RadianceField field = stages.run("illuminate", [&](const Progress& p) { return illuminate(rays, lights, voxels, radiance, p); });
  if (stages.cancelled()) return {};
  // What the stages before took counts against the limit; the gather never ends before its first pass.
  if (settings.timeLimitS > 0) gather.timeLimitS = std::max(1e-3, settings.timeLimitS - watch.seconds());
  GatheredPicture result = stages.run("gather", [&](const Progress& p) { return gatherCones(rays, lights, voxels, field, camera, gather, p); });

  stages.number("voxelSizeM", static_cast<double>(voxels.voxelSizeM));
  stages.number("voxels", static_cast<double>(voxels.voxels.size()));
  stages.number("slots", static_cast<double>(voxels.slots.size()));
  stages.number("voxelMiB", static_cast<double>(voxels.bytes()) / 1048576);
  stages.number("radianceMiB", static_cast<double>(field.bytes()) / 1048576);
  stages.number("bounces", field.bounces);
  stages.number("residual", field.residual);
  stages.number("samples", result.samples);
  stages.number("rays", static_cast<double>(field.rays + result.rays));
  stages.number("cones", static_cast<double>(result.cones));
  const Vec3 colour = lightColour(rays, camera, result.image);
  return {std::move(result.image), colour};
}

}  // namespace roomlight
