// What techniques `hybrid` and `cone` have in common as lit scenes: voxels and the light in them, kept up to date.
// Bricks of voxels, links, rays to lights and particles that a change has nothing to do with stay (see LightCache).
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "engine/light_store.h"
#include "engine/technique_settings.h"
#include "engine/time_plan.h"
#include "gather/frame.h"
#include "gather/meters.h"
#include "radiance/light_cache.h"
#include "radiance/slot_snapshot.h"
#include "voxel/voxelise.h"

namespace roomlight {

// Emissive meshes whose light quick frames find anew by themselves, since they may be edited again at once.
constexpr size_t kMostEdited = 8;  // each takes a ray of a pixel of quick frames

template <class Shader, class Settings>
class VoxelScene : public LitScene {
 public:
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
    return gatherView({rays(), lights()}, *shader_, camera, asked(gather_, wish), wish.history, progress);
  }
  std::shared_ptr<const SlotSnapshot> snapshot() const override {
    std::vector<uint32_t> edited = cache_->emittersApart(lights()) ? edited_ : std::vector<uint32_t>();
    const std::vector<Vec3> sharp = cache_->sharpLux(voxels(), edited);
    return std::make_shared<const SlotSnapshot>(voxels(), field().irradianceLux, sharp, std::move(edited));
  }

 protected:
  // Without light: light() finds it.
  VoxelScene(const Technique& technique, const Scene& scene, const Settings& gather, Stages& stages)
      : LitScene(technique, scene, true, stages), gather_(gather) {}

  // What only stills are taken of needs no more than the field; it is found within `use.seconds` where these are few.
  void light(const VoxelSettings& voxel, const RadianceSettings& radiance, const LitUse& use, Stages& stages) {
    radiance_ = radiance;
    if (use.stills) {
      fixed_ = std::isfinite(use.seconds) ? lightVoxelsWithin(use.seconds, {rays(), lights()}, voxel, radiance_, stages)
               : use.store                ? sharedLight(*use.store, rays(), lights(), voxel, radiance_, stages)
                                          : lightVoxels(rays(), lights(), voxel, radiance_, stages);
    } else {
      voxels_ = stages.run("voxelise", [&](const Progress&) { return voxelise(rays().scene(), voxel); });
      stages.run("illuminate", [&](const Progress& p) {
        cache_.emplace(rays(), lights(), voxels_.voxels, radiance_, p);
        return true;
      });
    }
    if (!stages.cancelled()) gather_ = fitted(gather_, voxels().voxelSizeM);
    makeShader(stages);
  }
  // Settings of the gather for voxels of this size.
  virtual Settings fitted(const Settings& settings, float) const { return settings; }
  // Light or things have changed.
  virtual void forgetViews() {}

  const Voxels& voxels() const { return cache_ ? voxels_.voxels : fixed_.voxels; }
  const RadianceField& field() const { return cache_ ? cache_->field() : fixed_.field; }
  const Settings& gatherSettings() const { return gather_; }
  const Shader* shader() const { return shader_ ? &*shader_ : nullptr; }

 private:
  bool settled() const override { return !cache_ || cache_->settled(); }
  // What voxels know of emission light does not ask: it follows when something moves.
  void relight(const SceneChange& change, Stages& stages) override {
    shader_.reset(), forgetViews();
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
        cache_.emplace(rays(), lights(), voxels_.voxels, radiance_, p);
      } else if (change.daylight) {
        cache_->followDaylight(rays(), lights(), voxels(), p);
      } else if (!change.any()) {
        cache_->goOn(rays(), lights(), voxels(), p);
      } else if (moved.empty()) {
        cache_->relight(rays(), lights(), voxels(), p);
      } else {
        cache_->update(rays(), lights(), voxels(), places, p);
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
  void makeShader(Stages& stages) {
    if (stages.cancelled()) return;
    stages.run("shader", [&](const Progress&) {
      shader_.emplace(rays(), lights(), voxels(), field(), gather_);
      return true;
    });
  }

  RadianceSettings radiance_;
  Settings gather_;
  Voxelisation voxels_;  // with cache_
  std::optional<LightCache> cache_;  // none: for stills
  VoxelLight fixed_;  // for stills
  std::vector<uint32_t> edited_;  // emissive meshes, the last time
  std::vector<uint32_t> glow_;  // instances that shine otherwise than voxels know
  std::optional<Shader> shader_;
};

}  // namespace roomlight
