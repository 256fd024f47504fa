// Technique `path`: path tracing. Rays follow the scene; every picture is traced anew.
#include <algorithm>
#include <cmath>

#include "base/image_layers.h"
#include "engine/settings.h"
#include "engine/technique.h"
#include "engine/technique_settings.h"
#include "reference/path_tracer.h"

namespace roomlight {
namespace {

constexpr int kDefaultSamples = 256;
constexpr int kNoLimit = 1 << 24;

PathSettings stageOf(const RenderSettings& settings) {
  PathSettings path = settings.path;
  path.width = settings.width;
  path.height = settings.height;
  const bool endsOtherwise = settings.timeLimitS > 0 || settings.noiseLevel > 0;
  path.samples = settings.samples > 0 ? settings.samples : endsOtherwise ? kNoLimit : kDefaultSamples;
  path.timeLimitS = settings.timeLimitS;
  path.noiseLevel = settings.noiseLevel;
  path.seed = settings.seed;
  return path;
}

class PathScene final : public LitScene {
 public:
  PathScene(const Scene& scene, const RenderSettings& settings, Stages& stages)
      : LitScene(kPathTechnique, scene, false, stages), settings_(stageOf(settings)) {}

  std::vector<MeterReading> illuminance(std::span<const SurfaceElement> elements, const MeterSettings& settings,
                                        const Progress& progress) const override {
    return measureIlluminance(rays(), lights(), elements, settings, progress);
  }
  Image pictureOf(const Camera& camera, const PictureWish& wish, const Progress& progress) const override {
    return pathTrace(rays(), lights(), camera, asked(settings_, wish), progress).image;
  }
  Result<Picture> still(const Camera& camera, double seconds, Stages& stages) override {
    PathSettings use = settings_;
    if (std::isfinite(seconds)) use.timeLimitS = std::max(1e-3, seconds);
    PathResult result =
        stages.run("path", [&](const Progress& p) { return pathTrace(rays(), lights(), camera, use, p); });
    splitLike(result.image, result.layers);
    stages.number("samples", result.samples);
    stages.number("noise", std::isfinite(result.noise) ? result.noise : -1);
    stages.number("rays", static_cast<double>(result.rays));
    return finished(camera, std::move(result.image), described(settings_.layers.get(), std::move(result.layers)));
  }
  void keepApart(std::shared_ptr<const LightLayers> layers) { settings_.layers = std::move(layers); }

 private:
  PathSettings settings_;
};

Result<std::unique_ptr<LitScene>> light(const Scene& scene, const RenderSettings& settings, const LitUse&,
                                        Stages& stages) {
  auto out = std::make_unique<PathScene>(scene, settings, stages);
  auto layers = wantedLayers(scene, out->lights(), settings);
  if (!layers) return Error{layers.error()};
  out->keepApart(std::move(layers).value());
  return std::unique_ptr<LitScene>(std::move(out));
}

}  // namespace

const Technique kPathTechnique{
    .name = technique::kPath,
    .about = "path tracing: the reference, slow and exact up to noise",
    .role = TechniqueRole::Judge,
    .layers = true,
    .followsDaylight = true,
    .fillsTimeLimit = true,
    .refinesToTruth = true,
    .meters = {.allowedPercent = 1, .isValidated = true, .places = 181, .worstPercent = 0.74},
    .light = light,
};

}  // namespace roomlight
