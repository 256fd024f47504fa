// Light in voxels that is kept up to date: what a change of lamps or a moved instance leaves as it is is not traced again.
#pragma once

#include <cstdint>
#include <vector>

#include "radiance/bounces.h"
#include "radiance/links.h"
#include "radiance/near_lamps.h"
#include "radiance/radiance_field.h"
#include "radiance/slot_light.h"
#include "radiance/slot_paths.h"

namespace roomlight {

class LightCache {
 public:
  // Lights everything. Where `progress` says stop, here or below, the field comes out without irradiance and the cache is of no
  // further use.
  LightCache(const RayScene& rays, const Lights& lights, const Voxels& voxels, const RadianceSettings& settings, const Progress& progress = {});

  // After lamps were switched, dimmed, coloured, moved, added or removed; suns, sky, emissive meshes and geometry are as before. Only
  // lamps in new places are traced, those dimmed or coloured are scaled, and bounces go on from the light there was.
  void relight(const RayScene& rays, const Lights& lights, const Voxels& voxels, const Progress& progress = {});

  const RadianceField& field() const { return field_; }
  RadianceField take() { return std::move(field_); }
  size_t bytes() const;  // beside the field

 private:
  // For 1 cd. Dark where it has been switched off: it may come back.
  struct LampLight {
    Lamp lamp;
    SlotLight direct;
    ParticleLight particles;
  };
  struct Sources {
    const RayScene& rays;
    const Lights& lights;
    const Voxels& voxels;
    const Progress& progress;
  };
  void traceAllLinks(const Sources& from);
  void traceFixedLights(const Sources& from);
  void traceLamp(const Sources& from, LampLight& light);
  void matchLamps(const Sources& from);
  void solve(const Sources& from);
  void fillField(const Sources& from, std::vector<Vec3>& near);
  std::vector<GlowPoint> glowPoints(const std::vector<Vec3>& glow) const;

  RadianceSettings settings_;
  SlotPaths paths_;
  Links links_;
  SlotLight suns_, sky_, emitters_;
  std::vector<LampLight> lamps_;
  std::vector<Vec3> direct_, indirect_;  // what bounces, and what has bounced; lx per slot
  RadianceField field_;
};

}  // namespace roomlight
