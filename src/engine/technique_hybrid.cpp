#include "base/split.h"
#include "engine/layers.h"
#include "engine/refine.h"
#include "engine/technique_settings.h"
#include "engine/techniques.h"
#include "engine/time_plan.h"
#include "gather/ray_shader.h"

namespace roomlight {
namespace {

constexpr int kMostForError = 256;  // samples, until no more error is left than asked

// What pictures of all cameras share: the light in voxels.
struct HybridScene {
  explicit HybridScene(const Scene& scene, Stages& stages)
      : rays(stages.run("bvh", [&](const Progress&) { return RayScene(scene); })),
        lights(stages.run("lights", [&](const Progress&) { return Lights(scene, true); })) {}
  const RayScene rays;
  const Lights lights;
  std::shared_ptr<const LightLayers> layers;
  VoxelLight light;
  std::optional<RayShader> shader;
};

class HybridPictures {
 public:
  HybridPictures(const Scene& scene, const RenderSettings& settings)
      : scene_(scene), settings_(settings), use_(hybridStages(settings)) {
    use_.gather.tellsError = true, use_.gather.untilMse = settings.blendUntilMse;
    if (settings.blendUntilMse > 0 && use_.gather.tolerance > 0 && settings.samples == 0)
      use_.gather.samples = std::max(use_.gather.samples, kMostForError);
  }
  Result<Picture> of(const Camera& camera, Stages& stages);

 private:
  double left(const Stopwatch& watch) const {
    return isLimited() ? std::max(0.0, settings_.timeLimitS - watch.seconds())
                       : std::numeric_limits<double>::infinity();
  }
  bool isLimited() const { return settings_.timeLimitS > 0; }
  Status light(const Stopwatch& watch, Stages& stages);

  const Scene& scene_;
  const RenderSettings& settings_;
  StageSettings<RayGatherSettings> use_;
  std::unique_ptr<HybridScene> lit_;  // null: there is no light yet
};

// Once cancelled it leaves no light.
Status HybridPictures::light(const Stopwatch& watch, Stages& stages) {
  auto lit = std::make_unique<HybridScene>(scene_, stages);
  const auto layers = wantedLayers(scene_, lit->lights, settings_);
  if (!layers) return Error{layers.error()};
  use_.radiance.layers = lit->layers = layers.value();
  lit->light = isLimited() ? lightVoxelsWithin(left(watch), lit->rays, lit->lights, use_.voxel, use_.radiance, stages)
                           : lightVoxels(lit->rays, lit->lights, use_.voxel, use_.radiance, stages);
  if (stages.cancelled()) return Ok{};
  use_.gather = withCells(use_.gather, lit->light.voxels.voxelSizeM);
  lit_ = std::move(lit);
  return Ok{};
}

Result<Picture> HybridPictures::of(const Camera& camera, Stages& stages) {
  const Stopwatch watch;
  if (!lit_) {
    if (const Status status = light(watch, stages); !status) return Error{status.error()};
  }
  if (!lit_) return Picture{};
  const HybridScene& lit = *lit_;
  GatheredPicture result = stages.run("gather", [&](const Progress& p) {
    if (!lit_->shader) lit_->shader.emplace(lit.rays, lit.lights, lit.light.voxels, lit.light.field, use_.gather);
    if (isLimited()) return gatherWithin(left(watch), lit.rays, lit.lights, *lit.shader, camera, use_.gather, p);
    return RayGather(lit.rays, lit.lights, *lit.shader, camera, use_.gather, p).picture(use_.gather, p);
  });
  const size_t gathered = result.image.pixels.size();
  if (result.image.width != settings_.width || result.image.height != settings_.height) {
    result.image = enlarged(result.image, settings_.width, settings_.height);
    for (Image& layer : result.layers) layer = enlarged(layer, settings_.width, settings_.height);
  }

  tellNumbers(lit.light, result, stages);
  stages.number("pixelsGathered", static_cast<double>(gathered));
  if (result.error.relative >= 0) stages.estimate(result.error.relative, result.error.srgbMse);
  const bool isGoodEnough =
      settings_.blendUntilMse > 0 && result.error.srgbMse >= 0 && result.error.srgbMse <= settings_.blendUntilMse;
  // Paths see the sky as it is, with its sun in it.
  const bool told = settings_.blend && (isLimited() || settings_.blendUntilMse > 0) && !isGoodEnough &&
                    !stages.cancelled() &&
                    refineByPath(lit.rays, Lights(scene_), camera, settings_, left(watch), stages, result.image);
  if (!told && result.error.relative >= 0)
    stages.number("estimatedError", result.error.relative), stages.number("estimatedMse", result.error.srgbMse);
  // What paths put right of the whole is put right of all its parts.
  splitLike(result.image, result.layers);
  return finished(lit.rays, camera, std::move(result.image), described(lit.layers.get(), std::move(result.layers)));
}

}  // namespace

PictureOf picturesByRays(const Scene& scene, const RenderSettings& settings) {
  return [pictures = std::make_shared<HybridPictures>(scene, settings)](const Camera& camera, Stages& stages) {
    return pictures->of(camera, stages);
  };
}

}  // namespace roomlight
