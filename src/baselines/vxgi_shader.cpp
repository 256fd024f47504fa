#include "baselines/vxgi.h"

#include "base/ggx.h"

namespace roomlight {

VxgiShader::VxgiShader(const RayScene& rays, const Lights& lights, const VxgiLight& light, const VxgiSettings& settings)
    : DirectShader(rays, lights, light.voxels, light.guide, settings.rayRoughness),
      map_(light.map),
      tracing_(settings),
      cones_(settings.cones),
      rotate_(settings.rotateCones) {}

Vec3 VxgiShader::indirect(const SurfacePoint& s, Sampler& sampler, GatherCounters& count, float&) const {
  count.cones += cones_.direction.size();
  return traceVxgiDiffuse(map_, {s.p, s.ng, s.ns}, cones_, rotate_ ? 2 * kPi * sampler.next1() : 0, tracing_);
}

// One cone about the direction of a mirror's reflection. Half of a GGX lobe's reflections lie within twice the atan of
// its alpha of it (at normal incidence), and half of a disc within its radius over the root of two: the cone is as wide
// as makes them agree.
Vec3 VxgiShader::glossy(const SurfacePoint& s, Vec3 wo, const BsdfSample& r, Sampler&, GatherCounters& count) const {
  const int level = map_.levelAt(s.p);
  if (level == map_.levels()) return {};
  ++count.cones;
  const Vec3 mirrored = s.ns * (2 * dot(s.ns, wo)) - wo, d = dot(mirrored, s.ng) > 0.02f ? mirrored : r.wi;
  const float alpha = ggxAlpha(s.m.roughness), halfRad = std::min(kPi / 4, 2.8284f * std::atan(alpha));
  return traceVxgiCone(map_, s.p + s.ng * (tracing_.startOffsetVoxels * map_.voxelSizeM(level)), d, std::tan(halfRad),
                       tracing_);
}

}  // namespace roomlight
