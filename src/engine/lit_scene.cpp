#include "engine/lit_scene.h"

#include <fmt/format.h>

#include <algorithm>

#include "baselines/photon.h"
#include "baselines/photon_shader.h"
#include "engine/lit_techniques.h"
#include "engine/technique_settings.h"
#include "gather/frame.h"
#include "gather/meters.h"
#include "reference/path_tracer.h"

namespace roomlight {
namespace {

// By technique `path`.
class TracedScene final : public LitScene {
 public:
  TracedScene(const Scene& scene, const RenderSettings& settings, Stages& stages)
      : LitScene(scene, false, stages), settings_(settings) {}
  std::vector<MeterReading> illuminance(std::span<const SurfaceElement> elements, const MeterSettings& settings,
                                        const Progress& progress) const override {
    return measureIlluminance(rays(), lights(), elements, settings, progress);
  }
  Image pictureOf(const Camera& camera, const PictureWish& wish, const Progress& progress) const override {
    return pathTrace(rays(), lights(), camera, asked(pathStage(settings_), wish), progress).image;
  }

 private:
  const RenderSettings settings_;
};

// By photon maps, made anew for what is asked.
class PhotonScene final : public LitScene {
 public:
  PhotonScene(const Scene& scene, const RenderSettings& settings, Stages& stages)
      : LitScene(scene, true, stages), settings_(photonStage(settings)) {}
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
    return gatherView(rays(), lights(), PhotonShader(rays(), lights(), light, use), camera, use, wish.history,
                      progress);
  }

 private:
  const PhotonSettings settings_;
};

}  // namespace

SceneRays::SceneRays(const Scene& scene, bool sunApart, Stages& stages)
    : sunApart_(sunApart),
      rays_(stages.run("bvh", [&](const Progress&) { return RayScene(scene); })),
      lights_(stages.run("lights", [&](const Progress&) { return Lights(scene, sunApart); })) {}

void SceneRays::follow(const SceneChange& change, Stages& stages) {
  const Scene& scene = rays_.scene();
  const bool emitters = !change.glow.empty() || std::any_of(change.moved.begin(), change.moved.end(), [&](uint32_t i) {
    return lights_->emitterOf(i) >= 0 ||
           !isBlack(
               scene.materials[static_cast<size_t>(scene.meshes[static_cast<size_t>(scene.instances[i].mesh)].material)]
                   .emission);
  });
  if (!change.moved.empty()) {
    stages.run("rays", [&](const Progress&) {
      rays_.update(change.moved);
      return true;
    });
  }
  if (change.daylight) {
    stages.run("lights", [&](const Progress&) {
      lights_.emplace(scene, sunApart_);
      return true;
    });
  } else if (change.lamps || emitters) {
    Lights next = stages.run("lights", [&](const Progress&) { return Lights(scene, std::move(*lights_)); });
    lights_.emplace(std::move(next));
  }
}

void LitScene::update(const SceneChange& change, Stages& stages) {
  if (!change.any() && settled()) return;
  base_.follow(change, stages);
  relight(change, stages);
}

Result<std::unique_ptr<LitScene>> lightScene(const Scene& scene, const RenderSettings& settings, Stages& stages,
                                             const LitUse& use) {
  if (const Status status = checkSettings(settings); !status) return Error{status.error()};
  std::unique_ptr<LitScene> out;
  if (settings.technique == "path") {
    out = std::make_unique<TracedScene>(scene, settings, stages);
  } else if (settings.technique == "photon") {
    out = std::make_unique<PhotonScene>(scene, settings, stages);
  } else if (settings.technique == "hybrid" || settings.technique == "cone") {
    out = lightByVoxels(scene, settings, stages, use.changes);
  } else if (settings.technique == "vxgi") {
    out = lightByVxgi(scene, settings, stages, use.camera);
  } else if (settings.technique == "lpv") {
    out = lightByLpv(scene, settings, stages, use.camera);
  } else {
    return Error{fmt::format("technique: unknown name '{}'", settings.technique)};
  }
  if (stages.cancelled()) return std::unique_ptr<LitScene>();
  return out;
}

}  // namespace roomlight
