#include "baselines/lpv.h"

namespace roomlight {

Vec3 LpvShader::indirect(const SurfacePoint& s, Sampler&, GatherCounters&, float&) const {
  return lpvIrradiance(light_, s.p, s.ng, s.ns, settings_);
}

Vec3 LpvShader::glossy(const SurfacePoint& s, Vec3, const BsdfSample& r, Sampler&, GatherCounters&) const {
  return lpvRadiance(light_, s.p, s.ng, r.wi, settings_);
}

}  // namespace roomlight
