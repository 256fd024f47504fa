// Light at surface points by photon maps: seen directly, or gathered by rays.
#pragma once

#include "baselines/photon_light.h"
#include "gather/direct_shader.h"

namespace roomlight {

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

}  // namespace roomlight
