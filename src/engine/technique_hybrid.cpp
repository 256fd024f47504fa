#include "base/split.h"
#include "engine/layers.h"
#include "engine/refine.h"
#include "engine/technique_settings.h"
#include "engine/techniques.h"
#include "engine/time_plan.h"

namespace roomlight {
namespace {

constexpr int kMostForError = 256;  // samples, until no more error is left than asked

}  // namespace

Result<Picture> renderHybrid(const Scene& scene, const Camera& camera, const RenderSettings& settings, Stages& stages) {
  const Stopwatch watch;
  const bool limited = settings.timeLimitS > 0;
  const auto left = [&] { return limited ? std::max(0.0, settings.timeLimitS - watch.seconds()) : std::numeric_limits<double>::infinity(); };
  StageSettings<RayGatherSettings> use = hybridStages(settings);
  use.gather.tellsError = true, use.gather.untilMse = settings.blendUntilMse;
  if (settings.blendUntilMse > 0 && use.gather.tolerance > 0 && settings.samples == 0) use.gather.samples = std::max(use.gather.samples, kMostForError);

  const RayScene rays = stages.run("bvh", [&](const Progress&) { return RayScene(scene); });
  const Lights lights = stages.run("lights", [&](const Progress&) { return Lights(scene, true); });
  const auto layers = wantedLayers(scene, lights, settings);
  if (!layers) return Error{layers.error()};
  use.radiance.layers = layers.value();
  const VoxelLight light = limited ? lightVoxelsWithin(left(), rays, lights, use.voxel, use.radiance, stages) : lightVoxels(rays, lights, use.voxel, use.radiance, stages);
  if (stages.cancelled()) return Picture{};
  GatheredPicture result = stages.run("gather", [&](const Progress& p) {
    if (limited) return gatherWithin(left(), rays, lights, light, camera, use.gather, p);
    return gatherRays(rays, lights, light.voxels, light.field, camera, use.gather, p);
  });
  const size_t gathered = result.image.pixels.size();
  if (result.image.width != settings.width || result.image.height != settings.height) {
    result.image = enlarged(result.image, settings.width, settings.height);
    for (Image& layer : result.layers) layer = enlarged(layer, settings.width, settings.height);
  }

  tellNumbers(light, result, stages);
  stages.number("pixelsGathered", static_cast<double>(gathered));
  if (result.error.relative >= 0) stages.estimate(result.error.relative, result.error.srgbMse);
  const bool isGoodEnough = settings.blendUntilMse > 0 && result.error.srgbMse >= 0 && result.error.srgbMse <= settings.blendUntilMse;
  // Paths see the sky as it is, with its sun in it.
  const bool told = settings.blend && (limited || settings.blendUntilMse > 0) && !isGoodEnough && !stages.cancelled() && refineByPath(rays, Lights(scene), camera, settings, left(), stages, result.image);
  if (!told && result.error.relative >= 0) stages.number("estimatedError", result.error.relative), stages.number("estimatedMse", result.error.srgbMse);
  // What paths put right of the whole is put right of all its parts.
  splitLike(result.image, result.layers);
  return finished(rays, camera, std::move(result.image), described(layers.value().get(), std::move(result.layers)));
}

}  // namespace roomlight
