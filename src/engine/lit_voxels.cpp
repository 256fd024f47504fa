// Techniques `hybrid` and `cone` as lit scenes: voxels and the light in them, kept up to date.
#include <mutex>

#include "engine/layers.h"
#include "engine/lit_techniques.h"
#include "engine/technique_settings.h"
#include "gather/cone_shader.h"
#include "gather/frame.h"
#include "gather/meters.h"
#include "gather/ray_gather.h"
#include "gather/ray_shader.h"
#include "radiance/light_cache.h"
#include "radiance/slot_snapshot.h"
#include "voxel/moved_places.h"

namespace roomlight {
namespace {

constexpr size_t kMostEdited = 8;  // each takes a ray of a pixel of quick frames
constexpr int kWorthSurvey = 4;    // samples of a picture that is worth to find out first where its rays arrive

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

template <class Shader, class Settings>
class VoxelScene final : public LitScene {
 public:
  VoxelScene(const Scene& scene, const RenderSettings& settings, const StageSettings<Settings>& use, bool changes,
             Stages& stages)
      : LitScene(scene, true, stages), radiance_(use.radiance), gather_(use.gather) {
    radiance_.still = !changes;  // what changes is followed by links
    if (const auto layers = wantedLayers(scene, lights(), settings)) radiance_.layers = layers.value();
    voxels_ = stages.run("voxelise", [&](const Progress&) { return voxelise(scene, use.voxel); });
    if constexpr (kByRays) gather_ = withCells(gather_, voxels_.voxels.voxelSizeM);
    stages.run("illuminate", [&](const Progress& p) {
      light_.emplace(rays(), lights(), voxels_.voxels, radiance_, p);
      return true;
    });
    makeShader(stages);
  }
  std::vector<MeterReading> illuminance(std::span<const SurfaceElement> elements, const MeterSettings& settings,
                                        const Progress& progress) const override {
    return measureIlluminance(rays(), lights(), *shader_, elements, settings, progress);
  }
  LayeredReadings illuminanceInLayers(std::span<const SurfaceElement> elements, const MeterSettings& settings,
                                      const Progress& progress) const override {
    if (!shader_ || !shader_->layers()) return {};
    return measureInLayers(rays(), lights(), *shader_, elements, settings, progress);
  }
  const LightLayers* layers() const override { return shader_ ? shader_->layers() : nullptr; }
  Image pictureOf(const Camera& camera, const PictureWish& wish, const Progress& progress) const override {
    if (!shader_) return {};
    const Settings use = asked(gather_, wish);
    if constexpr (kByRays) {
      if (!wish.history || use.samples >= kWorthSurvey) {
        const auto prepared = last_.of(
            camera, use.width, use.height, use.samples >= kWorthSurvey, [&]() -> std::shared_ptr<const RayGather> {
              auto made = std::make_shared<const RayGather>(rays(), lights(), *shader_, camera,
                                                            sized(gather_, use.width, use.height), progress);
              return progress.stop() ? nullptr : made;
            });
        if (prepared) return prepared->picture(use, progress).image;
      }
    }
    return gatherView(rays(), lights(), *shader_, camera, use, wish.history, progress);
  }
  std::shared_ptr<const SlotSnapshot> snapshot() const override {
    std::vector<uint32_t> edited = light_->emittersApart(lights()) ? edited_ : std::vector<uint32_t>();
    const std::vector<Vec3> sharp = light_->sharpLux(voxels_.voxels, edited);
    return std::make_shared<const SlotSnapshot>(voxels_.voxels, light_->field().irradianceLux, sharp,
                                                std::move(edited));
  }

 private:
  static constexpr bool kByRays = std::is_same_v<Shader, RayShader>;

  // What voxels know of emission light does not ask: it follows when something moves.
  void relight(const SceneChange& change, Stages& stages) override {
    shader_.reset(), last_.forget();
    noteEdited(change);
    glow_.insert(glow_.end(), change.glow.begin(), change.glow.end());
    const std::vector<uint32_t>& moved = change.moved;
    SceneChange behind = change;
    if (!moved.empty()) behind.glow = std::exchange(glow_, {});
    std::vector<Bounds3> places;
    if (!moved.empty())
      places = stages.run("voxelise", [&](const Progress&) { return followMoves(voxels_, rays().scene(), behind); });
    stages.run("illuminate", [&](const Progress& p) {
      if (change.daylight && !moved.empty()) {
        light_.emplace(rays(), lights(), voxels_.voxels, radiance_, p);
      } else if (change.daylight) {
        light_->followDaylight(rays(), lights(), voxels_.voxels, p);
      } else if (!change.any()) {
        light_->goOn(rays(), lights(), voxels_.voxels, p);
      } else if (moved.empty()) {
        light_->relight(rays(), lights(), voxels_.voxels, p);
      } else {
        light_->update(rays(), lights(), voxels_.voxels, places, p);
      }
      return true;
    });
    makeShader(stages);
  }
  // Emissive meshes that may be edited again at once.
  void noteEdited(const SceneChange& change) {
    std::vector<uint32_t> now;
    for (const std::vector<uint32_t>* list : {&change.glow, &change.moved}) {
      std::copy_if(list->begin(), list->end(), std::back_inserter(now),
                   [&](uint32_t i) { return lights().emitterOf(i) >= 0; });
    }
    if (!now.empty() && now.size() <= kMostEdited) edited_ = std::move(now);
  }
  bool settled() const override { return light_->settled(); }
  void makeShader(Stages& stages) {
    if (stages.cancelled()) return;
    stages.run("shader", [&](const Progress&) {
      shader_.emplace(rays(), lights(), voxels_.voxels, light_->field(), gather_);
      return true;
    });
  }

  RadianceSettings radiance_;
  Settings gather_;
  Voxelisation voxels_;
  std::vector<uint32_t> edited_;  // emissive meshes, the last time
  std::vector<uint32_t> glow_;  // instances that shine otherwise than voxels know
  std::optional<LightCache> light_;
  std::optional<Shader> shader_;
  mutable LastView last_;  // refers to the shader
};

}  // namespace

std::unique_ptr<LitScene> lightByVoxels(const Scene& scene, const RenderSettings& settings, Stages& stages,
                                        bool changes) {
  if (settings.technique == "cone")
    return std::make_unique<VoxelScene<ConeShader, GatherSettings>>(scene, settings, coneStages(settings), changes,
                                                                    stages);
  return std::make_unique<VoxelScene<RayShader, RayGatherSettings>>(scene, settings, hybridStages(settings), changes,
                                                                    stages);
}

}  // namespace roomlight
