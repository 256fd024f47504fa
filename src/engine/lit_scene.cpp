#include "engine/lit_scene.h"

#include <fmt/format.h>

#include "baselines/lpv_shader.h"
#include "baselines/photon.h"
#include "baselines/photon_shader.h"
#include "baselines/vxgi_shader.h"
#include "engine/technique_settings.h"
#include "engine/voxel_stages.h"
#include "gather/cone_shader.h"
#include "gather/meters.h"
#include "gather/ray_shader.h"
#include "reference/path_tracer.h"

namespace roomlight {
namespace {

template <class Settings>
Settings sized(Settings settings, int width, int height) {
  settings.width = width, settings.height = height;
  return settings;
}

// By technique `path`.
class TracedScene final : public LitScene {
 public:
  TracedScene(const Scene& scene, const RenderSettings& settings, Stages& stages) : LitScene(scene, false, stages), settings_(settings) {}
  std::vector<MeterReading> illuminance(std::span<const SurfaceElement> elements, const MeterSettings& settings, const Progress& progress) const override {
    return measureIlluminance(rays(), lights(), elements, settings, progress);
  }
  Image picture(const Camera& camera, int width, int height, const Progress& progress) const override {
    return pathTrace(rays(), lights(), camera, sized(pathStage(settings_), width, height), progress).image;
  }

 private:
  const RenderSettings settings_;
};

// By photon maps, made anew for what is asked.
class PhotonScene final : public LitScene {
 public:
  PhotonScene(const Scene& scene, const RenderSettings& settings, Stages& stages) : LitScene(scene, true, stages), settings_(photonStage(settings)) {}
  std::vector<MeterReading> illuminance(std::span<const SurfaceElement> elements, const MeterSettings& settings, const Progress& progress) const override {
    const PhotonLight light = lightPhotons(rays(), lights(), importonsFrom(elements), settings_, {{}, progress.cancelled});
    return measureIlluminance(rays(), lights(), PhotonShader(rays(), lights(), light, settings_), elements, settings, progress);
  }
  Image picture(const Camera& camera, int width, int height, const Progress& progress) const override {
    const PhotonSettings use = sized(settings_, width, height);
    const PhotonLight light = lightPhotons(rays(), lights(), importonsFrom(camera, width, height), use, {{}, progress.cancelled});
    return gatherPhotons(rays(), lights(), light, camera, use, progress).image;
  }

 private:
  const PhotonSettings settings_;
};

// By a shader that reads light from voxels.
template <class Shader, class Settings>
class VoxelScene final : public LitScene {
 public:
  VoxelScene(const Scene& scene, const StageSettings<Settings>& use, Stages& stages)
      : LitScene(scene, true, stages), gather_(use.gather), light_(lightVoxels(rays(), lights(), use.voxel, use.radiance, stages)) {
    if (!stages.cancelled()) shader_.emplace(rays(), lights(), light_.voxels, light_.field, gather_);
  }
  std::vector<MeterReading> illuminance(std::span<const SurfaceElement> elements, const MeterSettings& settings, const Progress& progress) const override {
    return measureIlluminance(rays(), lights(), *shader_, elements, settings, progress);
  }
  Image picture(const Camera& camera, int width, int height, const Progress& progress) const override {
    return gatherPicture(rays(), lights(), *shader_, camera, sized(gather_, width, height), progress).image;
  }

 private:
  const Settings gather_;
  const VoxelLight light_;
  std::optional<Shader> shader_;
};

// By a rival's method: `Light` is what its shader reads.
template <class Shader, class Settings, class Light>
class BaselineScene final : public LitScene {
 public:
  // light(rays, lights, settings, stages) -> Light.
  template <class Work>
  BaselineScene(const Scene& scene, const Settings& settings, Stages& stages, const Work& light)
      : LitScene(scene, true, stages), settings_(settings), light_(light(rays(), lights(), settings_, stages)), shader_(rays(), lights(), light_, settings_) {}
  std::vector<MeterReading> illuminance(std::span<const SurfaceElement> elements, const MeterSettings& settings, const Progress& progress) const override {
    return measureIlluminance(rays(), lights(), shader_, elements, settings, progress);
  }
  Image picture(const Camera& camera, int width, int height, const Progress& progress) const override {
    return gatherPicture(rays(), lights(), shader_, camera, sized(settings_, width, height), progress).image;
  }

 private:
  const Settings settings_;
  const Light light_;
  const Shader shader_;
};

// Without a camera, the finest level holds the whole scene.
VxgiLight wholeVxgi(const RayScene& rays, const Lights& lights, const VxgiSettings& settings, Stages& stages) {
  return stages.run("illuminate", [&](const Progress& p) { return lightVxgi(rays, lights, rays.bounds(), settings, p); });
}

LpvLight wholeLpv(const RayScene& rays, const Lights& lights, const LpvSettings& settings, Stages& stages) {
  return stages.run("illuminate", [&](const Progress& p) { return lightLpv(rays, lights, rays.bounds(), settings, p); });
}

}  // namespace

LitScene::LitScene(const Scene& scene, bool sunApart, Stages& stages)
    : rays_(stages.run("bvh", [&](const Progress&) { return RayScene(scene); })), lights_(stages.run("lights", [&](const Progress&) { return Lights(scene, sunApart); })) {}

Result<std::unique_ptr<LitScene>> lightScene(const Scene& scene, const RenderSettings& settings, Stages& stages) {
  if (const Status status = checkSettings(settings); !status) return Error{status.error()};
  std::unique_ptr<LitScene> out;
  if (settings.technique == "path") {
    out = std::make_unique<TracedScene>(scene, settings, stages);
  } else if (settings.technique == "photon") {
    out = std::make_unique<PhotonScene>(scene, settings, stages);
  } else if (settings.technique == "hybrid") {
    out = std::make_unique<VoxelScene<RayShader, RayGatherSettings>>(scene, hybridStages(settings), stages);
  } else if (settings.technique == "cone") {
    out = std::make_unique<VoxelScene<ConeShader, GatherSettings>>(scene, coneStages(settings), stages);
  } else if (settings.technique == "vxgi") {
    out = std::make_unique<BaselineScene<VxgiShader, VxgiSettings, VxgiLight>>(scene, vxgiStage(settings), stages, wholeVxgi);
  } else if (settings.technique == "lpv") {
    out = std::make_unique<BaselineScene<LpvShader, LpvSettings, LpvLight>>(scene, lpvStage(settings), stages, wholeLpv);
  } else {
    return Error{fmt::format("technique: unknown name '{}'", settings.technique)};
  }
  if (stages.cancelled()) return std::unique_ptr<LitScene>();
  return out;
}

}  // namespace roomlight
