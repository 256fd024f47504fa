// Technique `lpv` at one surface point: look-ups in its grids.
#pragma once

#include "baselines/lpv.h"
#include "gather/direct_shader.h"

namespace roomlight {

class LpvShader final : public DirectShader {
 public:
  // Refers to all of them.
  LpvShader(const RayScene& rays, const Lights& lights, const LpvLight& light, const LpvSettings& settings)
      : DirectShader(rays, lights, light.voxels, light.guide, settings.rayRoughness),
        light_(light),
        settings_(settings) {}

 private:
  Vec3 indirect(const SurfacePoint& s, Sampler& sampler, GatherCounters& count, float& occlusion) const override;
  Vec3 glossy(const SurfacePoint& s, Vec3 wo, const BsdfSample& r, Sampler& sampler,
              GatherCounters& count) const override;

  const LpvLight& light_;
  const LpvSettings& settings_;
};

}  // namespace roomlight
