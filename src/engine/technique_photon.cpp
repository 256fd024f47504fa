// Technique `photon`: photon maps, gathered by rays. Photons are sent anew for every picture, to where its camera
 // looks.
#include "baselines/photon.h"
#include "engine/settings.h"
#include "engine/technique.h"
#include "engine/technique_settings.h"
#include "gather/frame.h"
#include "gather/meters.h"

namespace roomlight {
namespace {

class PhotonScene final : public LitScene {
 public:
  PhotonScene(const Scene& scene, const RenderSettings& settings, Stages& stages)
      : LitScene(kPhotonTechnique, scene, true, stages), settings_(stageOf(settings, settings.photon)) {}

  std::vector<MeterReading> illuminance(std::span<const SurfaceElement> elements, const MeterSettings& settings,
                                        const Progress& progress) const override {
    const PhotonLight light =
        lightPhotons(rays(), lights(), importonsFrom(elements), settings_, {{}, progress.cancelled});
    return measureIlluminance(rays(), lights(), PhotonShader(rays(), lights(), light, settings_), elements, settings,
                              progress);
  }
  Image pictureOf(const Camera& camera, const PictureWish& wish, const Progress& progress) const override {
    const PhotonSettings use = asked(settings_, wish);
    const PhotonLight light =
        lightPhotons(rays(), lights(), importonsFrom(camera, wish.width, wish.height), use, {{}, progress.cancelled});
    return gatherView({rays(), lights()}, PhotonShader(rays(), lights(), light, use), camera, use, wish.history,
                      progress);
  }
  Result<Picture> still(const Camera& camera, double seconds, Stages& stages) override {
    const Stopwatch watch;
    const PhotonLight light = stages.run("photons", [&](const Progress& p) {
      return lightPhotons(rays(), lights(), importonsFrom(camera, settings_.width, settings_.height), settings_, p);
    });
    if (stages.cancelled()) return Picture{};
    const PhotonSettings use = within(seconds - watch.seconds(), settings_);
    GatheredPicture result =
        stages.run("gather", [&](const Progress& p) { return gatherPhotons(rays(), lights(), light, camera, use, p); });

    stages.number("photonsEmitted", static_cast<double>(light.emitted));
    stages.number("photonsKept", static_cast<double>(light.global.size()));
    stages.number("causticPhotonsKept", static_cast<double>(light.caustic.size()));
    stages.number("photonMiB", static_cast<double>(light.bytes()) / 1048576);
    stages.number("samples", result.samples);
    stages.number("rays", static_cast<double>(light.rays + result.rays));
    return finished(camera, std::move(result.image), {});
  }

 private:
  const PhotonSettings settings_;
};

Result<std::unique_ptr<LitScene>> light(const Scene& scene, const RenderSettings& settings, const LitUse&,
                                        Stages& stages) {
  return std::unique_ptr<LitScene>(std::make_unique<PhotonScene>(scene, settings, stages));
}

}  // namespace

const Technique kPhotonTechnique{
    .name = technique::kPhoton,
    .about = "photon mapping with final gathering, for comparison",
    .role = TechniqueRole::Rival,
    .followsDaylight = true,
    .meters = {},
    .light = light,
};

}  // namespace roomlight
