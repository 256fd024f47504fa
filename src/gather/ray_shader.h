// Light at surface points by rays, for many points at once: rays to lights, and rays that gather what other surfaces
// reflect and read it from the slots they hit. Where a slot cannot be trusted the path goes on from there, as in path
// tracing.
#pragma once

#include "gather/ray_gather.h"
#include "gather/ray_scatter.h"
#include "radiance/slot_cache.h"

namespace roomlight {

class RayShader final : public SurfaceShader {
 public:
  RayShader(const RayScene& rays, const Lights& lights, const Voxels& voxels, const RadianceField& field,
            const RayGatherSettings& settings);
  void shade(std::span<const Shading> work, std::span<const Shadow> shadows, std::span<SurfaceLight> light,
             GatherCounters& count) const override {
    shade(work, shadows, light, nullptr, nullptr, count);
  }
  void shadeInLayers(std::span<const Shading> work, std::span<const Shadow> shadows, std::span<SurfaceLight> light,
                     LayerSums& layers, GatherCounters& count) const override {
    shade(work, shadows, light, &layers, nullptr, count);
  }
  // Where a survey is given, rays read its cells where these know a place, slots elsewhere, and part of the rays
// follows its guide; light found far beyond what is expected is told apart.
  void shade(std::span<const Shading> work, std::span<const Shadow> shadows, std::span<SurfaceLight> light,
             LayerSums* layers, const HitSurvey* survey, GatherCounters& count) const;
  float voxelM() const { return voxels_.voxelSizeM; }
  const LightLayers* layers() const override { return field_.layers.lights.get(); }
  // Adds where rays from these surfaces arrive, but for what lies beside lamps. No light is asked for.
  void arrivals(std::span<const Shading> work, std::vector<HitArrival>& out, GatherCounters& count) const;
  // Luminance that a ray would read there.
  float found(const HitArrival& arrival, const HitCache& hits) const;

 private:
  bool apart(const Shading& work) const { return !work.followed && work.s.m.roughness < settings_.rayRoughness; }
  int estimates(const Shading& work) const {
    if (work.once) return 1;
    return settings_.estimates * (work.gathers > 0 ? work.gathers : apart(work) ? 1 : 0);
  }
  SurfaceLight start(const Shading& work, uint32_t index, std::span<const Shadow> shadows, GatherWork& w) const;
  static void sumUp(std::span<const Lobes> found, std::span<const Vec3> rare, std::span<const Vec3> mirrored,
                    SurfaceLight& out);
  static Vec3 addCaustics(const SurfacePoint& s, const Bsdf& bsdf, uint32_t index, GatherWork& w);
  void follow(GatherWork& w) const;
  void prefetch(GatherWork& w) const;
  float expectedRadiance(const SurfacePoint& s) const;
  float brightestAround(Vec3 p) const;
  void findBrightest();
  void arrive(const GatherPath& path, const Hit& hit, GatherWork& w) const;
  bool cached(const GatherPath& path, const Hit& hit, Vec3 p, Vec3 n, GatherWork& w) const;
  bool cachedFaintly(const GatherPath& path, const Hit& hit, Vec3 p, Vec3 n, GatherWork& w) const;
  void goOn(const GatherPath& path, SurfacePoint s, GatherWork& w) const;
  void read(const GatherPath& path, const Hit& hit, int64_t slot, Vec3 p, Vec3 n, GatherWork& w) const;
  void readCell(const GatherPath& path, const Hit& hit, const HitCell& cell, Vec3 p, Vec3 n, GatherWork& w) const;
  Vec3 sunward(const GatherPath& path, const Hit& hit, float sunLux, Vec3 normal) const;
  // Parts of a slot's light that a ray which finds it leaves to points of bright patches.
  struct LeftToPoints {
    float glow = 0, sun = 0;  // of all its light,
    float ofSun = 0;          // and of what the sun gives it
    float ray() const { return std::max(0.0f, 1 - glow - sun); }
  };
  // Light that a cache has of a place.
  struct CachedLight {
    Vec3 even;          // radiance, as it is spread evenly
    float lux, sunLux;  // on it, luminous; and what the sun gives of that
    Vec3 normal;        // of what the cache has there
    int64_t slot;       // that holds it; -1: none
  };
  // The share of light spread evenly that is the glossy lobe's; in its place that lobe now and then sends the path on.
  Vec3 leaveToGloss(const GatherPath& path, const Hit& hit, const CachedLight& light, GatherWork& w) const;
  LeftToPoints leftToPoints(const GatherPath& path, const CachedLight& light, Vec3 p, Vec3 n) const;
  void addCached(const GatherPath& path, const Hit& hit, const CachedLight& light, const LeftToPoints& points,
                 const LightOrigin& origin, GatherWork& w) const;
  void markGlow();
  void markAround(Int3 voxel);
  bool mayBeInGlow(Int3 voxel) const;
  bool isInGlow(Vec3 p, Vec3 n) const;
  bool shinesBesideLamps(int64_t slot) const {
    return slot >= 0 && !field_.glowShare.empty() && field_.glowShare[static_cast<size_t>(slot)] > 0;
  }
  void addBackground(const GatherPath& path, GatherWork& w) const;
  void traceShadows(GatherWork& w) const;
  void resolveUnsure(GatherWork& w) const;
  int32_t layerOf(uint32_t instance) const {
    const int32_t emitter = lights_.emitterOf(instance);
    return emitter < 0 ? -1 : field_.layers.lights->ofEmitter[static_cast<size_t>(emitter)];
  }
  Vec3 skyAlong(const GatherPath& path) const;
  Vec3 sunsAlong(const GatherPath& path) const;

  const RayScene& rays_;
  const Lights& lights_;
  const Voxels& voxels_;
  const RadianceField& field_;
  const SlotCache cache_;
  const BrightPatches patches_;
  SunGloss sunGloss_;
  const RayGatherSettings& settings_;
  const SharpLights sharp_;
  const RayScatter scatter_;
  float meanRadiance_ = 0,
        leastExpected_ =
            0;  // cd/m² of white surfaces: the mean over all slots, and the least that a place is expected to have
  Vec3 sunDirection_, sunColour_;  // where there is one alone; of luminance 1
  std::vector<float> ownBrightest_,
      brightest_;  // per voxel, cd/m²: of its slots, did they reflect all light, and with those of its neighbours
  std::vector<uint8_t> kind_;  // per instance: what about its surfaces the cache does not know
  std::vector<std::array<uint64_t, kBrickSize>>
      nearGlow_;  // per brick and layer of it, bit x + 8 y: in that voxel or one beside it a slot shines beside lamps
};

}  // namespace roomlight
