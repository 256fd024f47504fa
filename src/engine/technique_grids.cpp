// Techniques `vxgi` and `lpv`: light in grids that are finest about one place, which follows the camera from room to
// room. What they keep: of vxgi, voxels and direct light of every level as `hybrid` does, and openness of surfaces,
// while its clipmap is filled anew; of lpv, surfels and the sky's light on them, while maps, injection and propagation
// are done anew, as in every frame of that method.
#include "baselines/lpv.h"
#include "baselines/lpv_cache.h"
#include "baselines/scene_survey.h"
#include "baselines/vxgi.h"
#include "baselines/vxgi_cache.h"
#include "engine/settings.h"
#include "engine/technique.h"
#include "engine/technique_settings.h"
#include "gather/frame.h"
#include "gather/meters.h"

namespace roomlight {
namespace {

// `Method` is what its technique's light is kept by.
template <class Method>
class GridScene final : public LitScene {
 public:
  GridScene(const Scene& scene, const RenderSettings& settings, const Camera* camera, Stages& stages)
      : LitScene(Method::technique, scene, true, stages), settings_(stageOf(settings, Method::settings(settings))) {
    if (camera) room_ = roomAround(rays(), camera->worldFromCamera.w);
    light(stages);
  }
  std::vector<MeterReading> illuminance(std::span<const SurfaceElement> elements, const MeterSettings& settings,
                                        const Progress& progress) const override {
    return measureIlluminance(rays(), lights(), *shader_, elements, settings, progress);
  }
  Image pictureOf(const Camera& camera, const PictureWish& wish, const Progress& progress) const override {
    if (!shader_) return {};
    return gatherView({rays(), lights()}, *shader_, camera, asked(settings_, wish), wish.history, progress);
  }
  Result<Picture> still(const Camera& camera, double seconds, Stages& stages) override {
    const auto use = within(seconds, settings_);
    GatheredPicture result = stages.run(
        "gather", [&](const Progress& p) { return gatherPicture(rays(), lights(), *shader_, camera, use, p); });
    Method::tellNumbers(cache_->light(), result, stages);
    return finished(camera, std::move(result.image), {});
  }
  void lookFrom(const Camera& camera, Stages& stages) override {
    const Vec3 eye = camera.worldFromCamera.w;
    if (room_ && minComponent(min(eye - room_->lo, room_->hi - eye)) >= 0) return;
    room_ = roomAround(rays(), eye);
    light(stages);
  }

 private:
  bool settled() const override { return cache_->settled(); }
  void relight(const SceneChange& change, Stages& stages) override {
    shader_.reset();
    stages.run("illuminate", [&](const Progress& p) {
      cache_->update(rays(), lights(), change, p);
      return true;
    });
    makeShader(stages);
  }
  void light(Stages& stages) {
    shader_.reset();
    stages.run("illuminate", [&](const Progress& p) {
      cache_.emplace(rays(), lights(), room_.value_or(rays().bounds()), settings_, p);
      return true;
    });
    makeShader(stages);
  }
  void makeShader(Stages& stages) {
    if (!stages.cancelled()) shader_.emplace(rays(), lights(), cache_->light(), settings_);
  }

  const typename Method::Settings settings_;
  std::optional<Bounds3> room_;  // none: the finest level holds the whole scene
  std::optional<typename Method::Cache> cache_;
  std::optional<typename Method::Shader> shader_;
};

struct Vxgi {
  using Settings = VxgiSettings;
  using Cache = VxgiCache;
  using Shader = VxgiShader;
  static constexpr const Technique& technique = kVxgiTechnique;
  static const Settings& settings(const RenderSettings& all) { return all.vxgi; }
  static void tellNumbers(const VxgiLight& light, const GatheredPicture& picture, Stages& stages) {
    stages.number("voxelSizeM", static_cast<double>(light.map.voxelSizeM(0)));
    stages.number("voxels", static_cast<double>(light.sources));
    stages.number("radianceMiB", static_cast<double>(light.map.bytes()) / 1048576);
    stages.number("bounces", light.bounces);
    stages.number("residual", light.residual);
    stages.number("samples", picture.samples);
    stages.number("rays", static_cast<double>(light.rays + picture.rays));
    stages.number("cones", static_cast<double>(picture.cones));
  }
};

struct Lpv {
  using Settings = LpvSettings;
  using Cache = LpvCache;
  using Shader = LpvShader;
  static constexpr const Technique& technique = kLpvTechnique;
  static const Settings& settings(const RenderSettings& all) { return all.lpv; }
  static void tellNumbers(const LpvLight& light, const GatheredPicture& picture, Stages& stages) {
    size_t bytes = 0;
    for (const LpvLevel& level : light.levels) bytes += level.bytes();
    stages.number("cellM", static_cast<double>(light.levels.front().lattice().cellM));
    stages.number("coarseCellM", static_cast<double>(light.levels.back().lattice().cellM));
    stages.number("virtualLights", static_cast<double>(light.virtualLights));
    stages.number("surfels", static_cast<double>(light.surfels));
    stages.number("radianceMiB", static_cast<double>(bytes) / 1048576);
    stages.number("samples", picture.samples);
    stages.number("rays", static_cast<double>(light.rays + picture.rays));
  }
};

template <class Method>
Result<std::unique_ptr<LitScene>> light(const Scene& scene, const RenderSettings& settings, const LitUse& use,
                                        Stages& stages) {
  return std::unique_ptr<LitScene>(std::make_unique<GridScene<Method>>(
      scene, settings, use.cameras.empty() ? nullptr : &use.cameras.front(), stages));
}

}  // namespace

const Technique kVxgiTechnique{
    .name = technique::kVxgi,
    .about = "voxel cone tracing with clipmaps, for comparison",
    .role = TechniqueRole::Rival,
    .keepsWhatStands = true,
    .meters = {},
    .light = light<Vxgi>,
};

const Technique kLpvTechnique{
    .name = technique::kLpv,
    .about = "light propagation volumes, for comparison",
    .role = TechniqueRole::Rival,
    .keepsWhatStands = true,
    .meters = {},
    .light = light<Lpv>,
};

}  // namespace roomlight
