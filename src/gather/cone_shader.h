// Technique `cone` at one surface point: cones for diffuse light and where reflections are rough.
#pragma once

#include "gather/cone_gather.h"
#include "gather/direct_shader.h"
#include "radiance/cone_march.h"

namespace roomlight {

class ConeShader final : public DirectShader {
 public:
  ConeShader(const RayScene& rays, const Lights& lights, const Voxels& voxels, const RadianceField& field,
             const GatherSettings& settings);

 private:
  Vec3 indirect(const SurfacePoint& s, Sampler& sampler, GatherCounters& count, float& occlusion) const override;
  Vec3 glossy(const SurfacePoint& s, Vec3 wo, const BsdfSample& r, Sampler& sampler,
              GatherCounters& count) const override;
  Vec3 reflectedIrradiance(const SurfacePoint& s, Vec3 direction, const Reflected& from, Sampler& sampler,
                           GatherCounters& count) const override;
  void addNear(const SurfacePoint& s, const Bsdf& bsdf, Reflection by, Sampler& sampler, Lobes& sum,
               GatherCounters& count) const override;
  float conePdf(float cosSurface) const;
  ConeShape lobe(const SurfacePoint& s, float pdf) const;
  ConeStart coneStart(const SurfacePoint& s) const;
  Vec3 seen(Ray ray, const Reflected& from, Vec3 startLux, Sampler& sampler, GatherCounters& count) const;
  bool isParted(size_t slot, const SurfacePoint& s, GatherCounters& count) const;
  int64_t slotNear(const SurfacePoint& s, Sampler& sampler) const;

  const RadianceField& field_;
  const GatherSettings& settings_;
  const ConeShape diffuse_;
};

}  // namespace roomlight
