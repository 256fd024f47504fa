// Technique `hybrid`: exact rays that read light cached in voxels; left running, it is refined by paths.
#include <algorithm>
#include <mutex>

#include "base/image_layers.h"
#include "engine/settings.h"
#include "engine/technique.h"
#include "engine/technique_settings.h"
#include "engine/time_plan.h"
#include "engine/voxel_scene.h"
#include "gather/ray_gather.h"
#include "gather/ray_shader.h"

namespace roomlight {
namespace {

// Rays decide what is seen, so voxels may be coarser than cones need them: a third of the slots, and no more error.
constexpr float kCoarser = 1.5f;
constexpr int kMostForNoise = 256;  // samples, until no pixel has more noise than asked
constexpr int kMostForError = 256;  // samples, until no more error is left than asked
constexpr int kWorthSurvey = 4;     // samples of a picture that is worth to find out first where its rays arrive

RayGatherSettings gatherOf(const RenderSettings& settings) {
  RayGatherSettings out = stageOf(settings, settings.hybrid);
  if (settings.samples > 0 || settings.noiseLevel > 0) out.countsBySize = false;
  if (settings.noiseLevel > 0) {
    out.tolerance = static_cast<float>(settings.noiseLevel);
    if (settings.samples == 0) out.samples = kMostForNoise;
  }
  return out;
}

// What still pictures of the camera that asked last share.
class LastView {
 public:
  // Made anew for another camera or size if that is `worth` it; null if not, and where `make` returns null.
  template <class Make>
  std::shared_ptr<const RayGather> of(const Camera& camera, int width, int height, bool worth, const Make& make) {
    const std::lock_guard lock(mutex_);
    const bool isKnown = gather_ && width == width_ && height == height_ && seeTheSame(gather_->camera(), camera);
    if (isKnown || !worth) return isKnown ? gather_ : nullptr;
    width_ = width, height_ = height, gather_ = make();
    return gather_;
  }
  void forget() { gather_ = {}; }

 private:
  std::mutex mutex_;
  int width_ = 0, height_ = 0;
  std::shared_ptr<const RayGather> gather_;
};

class HybridScene final : public VoxelScene<RayShader, RayGatherSettings> {
 public:
  HybridScene(const Scene& scene, const RenderSettings& settings, Stages& stages)
      : VoxelScene(kHybridTechnique, scene, gatherOf(settings), stages), settings_(settings) {}

  Status lightIt(const LitUse& use, Stages& stages) {
    VoxelSettings voxel = settings_.voxel;
    voxel.sizeFactor *= kCoarser;
    RadianceSettings radiance = settings_.radiance;
    radiance.seed = settings_.seed;
    radiance.pyramid = false;
    radiance.still = !use.changes;  // what changes is followed by links
    if (use.stills) radiance.views.assign(use.cameras.begin(), use.cameras.end());
    const auto layers = wantedLayers(rays().scene(), lights(), settings_);
    if (!layers) return Error{layers.error()};
    radiance.layers = layers.value();
    light(voxel, radiance, use, stages);
    return Ok{};
  }

  Image pictureOf(const Camera& camera, const PictureWish& wish, const Progress& progress) const override {
    if (!shader()) return {};
    RayGatherSettings use = asked(gatherSettings(), wish);
    if (wish.samples > 0) use.countsBySize = false;
    if (!wish.history || use.samples >= kWorthSurvey) {
      const auto prepared = last_.of(
          camera, use.width, use.height, use.samples >= kWorthSurvey, [&]() -> std::shared_ptr<const RayGather> {
            auto made = std::make_shared<const RayGather>(rays(), lights(), *shader(), camera,
                                                          sized(gatherSettings(), use.width, use.height), progress);
            return progress.stop() ? nullptr : made;
          });
      if (prepared) return prepared->picture(use, progress).image;
    }
    return VoxelScene::pictureOf(camera, wish, progress);
  }
  Result<Picture> still(const Camera& camera, double seconds, Stages& stages) override;

 private:
  RayGatherSettings fitted(const RayGatherSettings& settings, float voxelSizeM) const override {
    return withCells(settings, voxelSizeM);
  }
  void forgetViews() override { last_.forget(); }
  RayGatherSettings forStills() const {
    RayGatherSettings out = gatherSettings();
    out.tellsError = true, out.untilMse = settings_.blendUntilMse;
    if (settings_.blendUntilMse > 0 && out.tolerance > 0 && settings_.samples == 0)
      out.samples = std::max(out.samples, kMostForError), out.countsBySize = false;
    return out;
  }

  const RenderSettings settings_;
  mutable LastView last_;  // refers to the shader
};

Result<Picture> HybridScene::still(const Camera& camera, double seconds, Stages& stages) {
  const Stopwatch watch;
  const bool isLimited = std::isfinite(seconds);
  const auto left = [&] { return std::max(0.0, seconds - watch.seconds()); };
  const RayGatherSettings use = forStills();
  GatheredPicture result = stages.run("gather", [&](const Progress& p) {
    if (isLimited) return gatherWithin(left(), {rays(), lights()}, *shader(), camera, use, p);
    return RayGather(rays(), lights(), *shader(), camera, use, p).picture(use, p);
  });
  const size_t gathered = result.image.pixels.size();
  if (result.image.width != settings_.width || result.image.height != settings_.height) {
    result.image = enlarged(result.image, settings_.width, settings_.height);
    for (Image& layer : result.layers) layer = enlarged(layer, settings_.width, settings_.height);
  }

  tellNumbers(voxels(), field(), result, stages);
  stages.number("pixelsGathered", static_cast<double>(gathered));
  if (result.error.relative >= 0) stages.estimate(result.error.relative, result.error.srgbMse);
  const bool isGoodEnough =
      settings_.blendUntilMse > 0 && result.error.srgbMse >= 0 && result.error.srgbMse <= settings_.blendUntilMse;
  // Paths see the sky as it is, with its sun in it.
  const bool told = settings_.blend && (isLimited || settings_.blendUntilMse > 0) && !isGoodEnough &&
                    !stages.cancelled() &&
                    refineByPath({rays(), Lights(rays().scene())}, camera, settings_, left(), stages, result.image);
  if (!told && result.error.relative >= 0)
    stages.number("estimatedError", result.error.relative), stages.number("estimatedMse", result.error.srgbMse);
  // What paths put right of the whole is put right of all its parts.
  splitLike(result.image, result.layers);
  return finished(camera, std::move(result.image), described(layers(), std::move(result.layers)));
}

Result<std::unique_ptr<LitScene>> light(const Scene& scene, const RenderSettings& settings, const LitUse& use,
                                        Stages& stages) {
  const Stopwatch watch;
  auto out = std::make_unique<HybridScene>(scene, settings, stages);
  LitUse left = use;
  left.seconds = std::max(0.0, use.seconds - watch.seconds());
  if (const Status status = out->lightIt(left, stages); !status) return Error{status.error()};
  return std::unique_ptr<LitScene>(std::move(out));
}

}  // namespace

const Technique kHybridTechnique{
    .name = technique::kHybrid,
    .about = "exact rays that read light cached in voxels: fast, without leaks",
    .role = TechniqueRole::Own,
    .layers = true,
    .followsDaylight = true,
    .keepsWhatStands = true,
    .hasSnapshots = true,
    .fillsTimeLimit = true,
    .sharesLight = true,
    .refinesToTruth = true,
    .meters = {.isValidated = true,
               .places = 181,
               .worstPercent = 1.47,
               .furnishedWithinPercent = 10.6,
               .furnishedMeanPercent = 0.6},
    .light = light,
};

}  // namespace roomlight
