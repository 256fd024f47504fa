#include "engine/technique_settings.h"
#include "engine/techniques.h"
#include "engine/voxel_stages.h"
#include "gather/cone_gather.h"

namespace roomlight {
namespace {

// A scene with light in voxels.
struct ConeScene {
  RayScene rays;
  Lights lights;
  VoxelLight light;
};

std::unique_ptr<const ConeScene> lightForCones(const Scene& scene, const StageSettings<GatherSettings>& use,
                                               Stages& stages) {
  RayScene rays = stages.run("bvh", [&](const Progress&) { return RayScene(scene); });
  Lights lights = stages.run("lights", [&](const Progress&) { return Lights(scene, true); });
  auto out = std::make_unique<ConeScene>(ConeScene{std::move(rays), std::move(lights), {}});
  out->light = lightVoxels(out->rays, out->lights, use.voxel, use.radiance, stages);
  return stages.cancelled() ? nullptr : std::move(out);
}

}  // namespace

PictureOf picturesByCones(const Scene& scene, const RenderSettings& settings) {
  return [&scene, &settings, kept = std::shared_ptr<const ConeScene>()](const Camera& camera,
                                                                        Stages& stages) mutable -> Result<Picture> {
    if (settings.layers) return Error{"layers: technique cone does not keep lamps apart; use hybrid or path"};
    const Stopwatch watch;
    StageSettings<GatherSettings> use = coneStages(settings);
    if (!kept) kept = lightForCones(scene, use, stages);
    if (!kept) return Picture{};
    // What the stages before took counts against the limit; the gather never ends before its first pass.
    if (settings.timeLimitS > 0) use.gather.timeLimitS = std::max(1e-3, settings.timeLimitS - watch.seconds());
    GatheredPicture result = stages.run("gather", [&](const Progress& p) {
      return gatherCones(kept->rays, kept->lights, kept->light.voxels, kept->light.field, camera, use.gather, p);
    });

    tellNumbers(kept->light, result, stages);
    stages.number("cones", static_cast<double>(result.cones));
    return finished(kept->rays, camera, std::move(result.image), {});
  };
}

}  // namespace roomlight
