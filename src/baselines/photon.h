// Technique `photon`: pictures and meter readings by photon mapping (Jensen 1996, 2001).
#pragma once

#include "baselines/photon_estimate.h"
#include "baselines/photon_importance.h"
#include "baselines/scene_survey.h"
#include "gather/direct_shader.h"
#include "scene/scene.h"
#include "trace/meter.h"

namespace roomlight {

// What technique `photon` knows of a scene's light before it draws: photon maps, irradiance at photons, where the sky
// is seen.
struct PhotonLight {
  PhotonMap global, caustic;
  IrradianceCache irradiance;  // with final gathering
  SkySurvey survey;
  uint64_t emitted = 0, rays = 0;
  size_t bytes() const { return global.bytes() + caustic.bytes() + irradiance.bytes() + survey.voxels.bytes(); }
};

// For what `start` asks about. Refers to nothing afterwards. Stopped early it is of no use.
PhotonLight lightPhotons(const RayScene& rays, const Lights& lights, const ImportonStart& start,
                         const PhotonSettings& settings, const Progress& progress = {});

// Light at surface points by photon maps: seen directly, or gathered by rays.
class PhotonShader final : public DirectShader {
 public:
  PhotonShader(const RayScene& rays, const Lights& lights, const PhotonLight& light, const PhotonSettings& settings);

 private:
  Vec3 indirect(const SurfacePoint& s, Sampler& sampler, GatherCounters& count, float& occlusion) const override;
  Vec3 glossy(const SurfacePoint& s, Vec3 wo, const BsdfSample& r, Sampler& sampler,
              GatherCounters& count) const override;
  Vec3 reflectedIrradiance(const SurfacePoint& s, Vec3 direction, const Reflected& from, Sampler& sampler,
                           GatherCounters& count) const override;
  Vec3 gathered(const SurfacePoint& s, int rays, int depth, Sampler& sampler, GatherCounters& count) const;
  Vec3 arriving(Ray ray, Hit hit, int depth, Sampler& sampler, GatherCounters& count) const;
  Vec3 lit(const SurfacePoint& s, Vec3 direction, float distanceM, int depth, Sampler& sampler,
           GatherCounters& count) const;
  Vec3 causticsAt(const SurfacePoint& s, GatherCounters& count) const;

  const PhotonLight& light_;
  const PhotonSettings& settings_;
  const PhotonEstimate global_, caustic_;
};

// What a camera sees, or what falls on elements.
ImportonStart importonsFrom(const Camera& camera, int width, int height);
ImportonStart importonsFrom(std::span<const SurfaceElement> elements);

GatheredPicture gatherPhotons(const RayScene& rays, const Lights& lights, const PhotonLight& light,
                              const Camera& camera, const PhotonSettings& settings, const Progress& progress = {});

}  // namespace roomlight
