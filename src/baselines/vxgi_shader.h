// Technique `vxgi` at one surface point: diffuse and specular cones through its clipmap.
#pragma once

#include "baselines/vxgi.h"
#include "gather/direct_shader.h"

namespace roomlight {

class VxgiShader final : public DirectShader {
 public:
  // Refers to all but the settings.
  VxgiShader(const RayScene& rays, const Lights& lights, const VxgiLight& light, const VxgiSettings& settings);

 private:
  Vec3 indirect(const SurfacePoint& s, Sampler& sampler, GatherCounters& count, float& occlusion) const override;
  Vec3 glossy(const SurfacePoint& s, Vec3 wo, const BsdfSample& r, Sampler& sampler,
              GatherCounters& count) const override;

  const VxgiClipmap& map_;
  const VxgiTracing tracing_;
  const VxgiCones cones_;
  const bool rotate_;
};

}  // namespace roomlight
