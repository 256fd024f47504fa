// Light in voxels that is kept up to date: what a change of lamps or a moved instance leaves as it is is not traced
 // again.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "radiance/bounces.h"
#include "radiance/light_sources.h"
#include "radiance/links.h"
#include "radiance/radiance_field.h"
#include "radiance/slot_paths.h"
#include "radiance/slot_remap.h"

namespace roomlight {

class LightCache {
 public:
  // Lights everything. Where `progress` says stop, here or below, the field comes out without irradiance and the cache
  // is of no further use.
  LightCache(const RayScene& rays, const Lights& lights, const Voxels& voxels, const RadianceSettings& settings,
             const Progress& progress = {});

  // After lamps were switched, dimmed, coloured, moved, added or removed, or emissive meshes switched, dimmed or
  // coloured; suns, sky and geometry are as before. Only lamps in new places are traced, those dimmed or coloured are
  // scaled, and bounces go on from the light there was.
  void relight(const RayScene& rays, const Lights& lights, const Voxels& voxels, const Progress& progress = {});

  // After the suns or the sky changed; lamps and the light of emissive meshes may have changed too, geometry is as
  // before. Bounces go on from the light there was, darkened as what they come from.
  void followDaylight(const RayScene& rays, const Lights& lights, const Voxels& voxels, const Progress& progress = {});

  // After instances moved, appeared or vanished; suns and sky are as before, lamps and the light of emissive meshes may
  // have changed too. `rays`, `lights` and `voxels` are of the scene as it is now; `places`: where they were and where
  // they are, m (see followMoves); none empty. What changed bricks, or ways that cross the changed places, have to do
  // with is traced again; the rest comes out as if all were lit anew with the same seed.
  void update(const RayScene& rays, const Lights& lights, const Voxels& voxels, std::span<const Bounds3> places,
              const Progress& progress = {});

  // Goes on with bounces that an update left over (see RadianceSettings::bouncesAtOnce): with twice as many as the call
  // before made.
  void goOn(const RayScene& rays, const Lights& lights, const Voxels& voxels, const Progress& progress = {});
  // Whether bounces have come to their end.
  bool settled() const { return settled_; }

  const RadianceField& field() const { return field_; }
  // Of the field's irradiance what comes straight from suns, from lamps that have sharp shadows (trace/lamp_light.h)
  // and from the emissive meshes that these instances are, where they are kept apart; lx per slot. What particles of
  // these bring is not in it.
  std::vector<Vec3> sharpLux(const Voxels& voxels, std::span<const uint32_t> emissive = {}) const;
  // Whether the light of each emissive mesh is kept.
  bool emittersApart(const Lights& lights) const { return EmitterSources::apart(settings_, lights); }
  // Whether that of each lamp is. Where scenes stay as they are many are lit together.
  bool lampsApart(const Lights& lights) const { return LampSources::apart(settings_, lights); }
  RadianceField take() { return std::move(field_); }
  size_t bytes() const;  // beside the field

 private:
  struct LayerDirect {
    std::vector<Vec3> all, near;  // lx per slot, as in direct_; near: empty where there is none
    std::vector<Vec3> held;  // of the sun, as sunHeld_; else empty
    std::vector<uint8_t> straight;  // per brick: whether any comes straight
  };
  struct Home {  // as it is now
    const RayScene& rays;
    const Lights& lights;
    const Voxels& voxels;
    const Progress& progress;
  };
  SlotSampling slots(const Home& home) const { return {home.voxels, paths_, settings_.seed}; }
  LightTracing tracing(const Home& home) {
    return {home.rays, home.lights, home.voxels, home.progress, paths_,
            settings_, field_,      importance_, fewParticles_, field_.rays};
  }
  SkyGuide traceAllLinks(const Home& home);
  void updateLinks(const Home& home, const SlotPaths& paths, const SlotChange& change);
  SkyGuide findGuide(const Home& home);
  void learnLights(const Home& home);
  void matchSources(const Home& home);
  std::vector<LitParticles> litParticles() const;
  void solve(const Home& home, int mostBounces);
  void holdSun(const Home& home);
  std::vector<Vec3> sumDirect(const Home& home);
  void bounceOn(const Home& home, int mostBounces, std::vector<Vec3>& near);
  int bouncesOfUpdate();
  void splitIntoLayers(const Home& home, const Bounces& like);
  void keepShares(size_t layer, const std::vector<Vec3>& direct, const std::vector<Vec3>& indirect,
                  const std::vector<Vec3>& near, const std::vector<Vec3>& held, std::vector<float>& mostGlow);
  LayerDirect directOf(const Home& home, const LightLayers& layers, int32_t layer);
  void fillField(const Home& home, std::vector<Vec3>& near);
  std::vector<GlowPoint> glowPoints(const std::vector<Vec3>& glow) const;

  RadianceSettings settings_;
  SlotPaths paths_;
  BrickImportance importance_;
  Links links_;
  std::vector<BrickMark> marks_;
  DaylightSource daylight_;
  EmitterSources emitters_;
  LampSources lamps_;
  std::vector<Vec3> sunHeld_;  // straight from the sun, lx per slot, of slots whose reflection is sampled by place; not
                               // in direct_, for that has been passed on
  std::vector<std::vector<Vec3>>
      hidden_;  // of each layer, what it lights of hidden places, as lightOfHidden(); until it is told apart
  std::vector<Vec3> sunArrives_;  // what they have sent on: in direct_
  std::vector<Vec3> direct_, indirect_;  // what bounces, and what has bounced; lx per slot
  int mostAtOnce_ = 0;  // bounces, the last time
  bool settled_ = true;
  bool fewParticles_ = false;  // where light is followed in steps: of what has moved, the rest follows with bounces
  RadianceField field_;
};

}  // namespace roomlight
