// Techniques `vxgi` and `lpv` as lit scenes: finest about one place, which follows the camera from room to room.
#include "baselines/lpv_cache.h"
#include "baselines/lpv_shader.h"
#include "baselines/room_around.h"
#include "baselines/vxgi_cache.h"
#include "baselines/vxgi_shader.h"
#include "engine/lit_techniques.h"
#include "engine/technique_settings.h"
#include "gather/frame.h"
#include "gather/meters.h"

namespace roomlight {
namespace {

// `Method` is what its technique's light is kept by.
template <class Method>
class BaselineScene final : public LitScene {
 public:
  BaselineScene(const Scene& scene, const typename Method::Settings& settings, Stages& stages, const Camera* camera)
      : LitScene(scene, true, stages), settings_(settings) {
    if (camera) room_ = roomAround(rays(), camera->worldFromCamera.w);
    light(stages);
  }
  std::vector<MeterReading> illuminance(std::span<const SurfaceElement> elements, const MeterSettings& settings,
                                        const Progress& progress) const override {
    return measureIlluminance(rays(), lights(), *shader_, elements, settings, progress);
  }
  Image pictureOf(const Camera& camera, const PictureWish& wish, const Progress& progress) const override {
    if (!shader_) return {};
    return gatherView(rays(), lights(), *shader_, camera, asked(settings_, wish), wish.history, progress);
  }
  bool followsDaylight() const override { return false; }
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
};

struct Lpv {
  using Settings = LpvSettings;
  using Cache = LpvCache;
  using Shader = LpvShader;
};

}  // namespace

std::unique_ptr<LitScene> lightByVxgi(const Scene& scene, const RenderSettings& settings, Stages& stages,
                                      const Camera* camera) {
  return std::make_unique<BaselineScene<Vxgi>>(scene, vxgiStage(settings), stages, camera);
}

std::unique_ptr<LitScene> lightByLpv(const Scene& scene, const RenderSettings& settings, Stages& stages,
                                     const Camera* camera) {
  return std::make_unique<BaselineScene<Lpv>>(scene, lpvStage(settings), stages, camera);
}

}  // namespace roomlight
