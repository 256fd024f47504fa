#include "baselines/photon.h"
#include "engine/technique_settings.h"
#include "engine/techniques.h"

namespace roomlight {

Result<Picture> renderPhoton(const Scene& scene, const Camera& camera, const RenderSettings& settings, Stages& stages) {
  if (settings.layers) return Error{"layers: technique photon does not keep lamps apart; use hybrid or path"};
  const Stopwatch watch;
  PhotonSettings use = photonStage(settings);

  const RayScene rays = stages.run("bvh", [&](const Progress&) { return RayScene(scene); });
  const Lights lights = stages.run("lights", [&](const Progress&) { return Lights(scene, true); });
  const PhotonLight light = stages.run("photons", [&](const Progress& p) {
    return lightPhotons(rays, lights, importonsFrom(camera, use.width, use.height), use, p);
  });
  if (stages.cancelled()) return Picture{};
  // What the stages before took counts against the limit; the gather never ends before its first pass.
  if (settings.timeLimitS > 0) use.timeLimitS = std::max(1e-3, settings.timeLimitS - watch.seconds());
  GatheredPicture result =
      stages.run("gather", [&](const Progress& p) { return gatherPhotons(rays, lights, light, camera, use, p); });

  stages.number("photonsEmitted", static_cast<double>(light.emitted));
  stages.number("photonsKept", static_cast<double>(light.global.size()));
  stages.number("causticPhotonsKept", static_cast<double>(light.caustic.size()));
  stages.number("photonMiB", static_cast<double>(light.bytes()) / 1048576);
  stages.number("samples", result.samples);
  stages.number("rays", static_cast<double>(light.rays + result.rays));
  return finished(rays, camera, std::move(result.image), {});
}

}  // namespace roomlight
