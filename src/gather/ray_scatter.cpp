#include "gather/ray_scatter.h"

#include "base/sampling.h"
#include "radiance/sky_guide.h"
#include "trace/shadow_ray.h"

namespace roomlight {
namespace {

constexpr float kNothing = 1e-4f;

}  // namespace

RayScatter::RayScatter(const Lights& lights, const Voxels& voxels, const RadianceField& field, bool sampleLamps) : lights_(lights), field_(field), sampleLamps_(sampleLamps), besideEmitters_(emitterSurroundings(lights, voxels.voxelSizeM)) {
  for (size_t i = 0; i < lights.lampCount(); ++i) besideLamps_.emplace_back(lights.lamp(i), voxels.voxelSizeM);
}

// Sends rays from a surface: to lights, and on to other surfaces.
void RayScatter::from(const GatherVertex& v, GatherWork& w) const {
  lightsAt(v, w);
  if (!field_.glow.empty()) glowAt(v, w);
  gatherAt(v, w);
}

float RayScatter::cosinePdf(const GatherVertex& v, Vec3 wi) { return std::max(0.0f, dot(wi, v.s.ns)) / kPi; }

void RayScatter::lightsAt(const GatherVertex& v, GatherWork& w) const {
  Sampler& sampler = w.samplers[v.estimate];
  const auto take = [&](const LightSample& light) {
    if (!light.valid() || dot(light.wi, v.s.ng) <= 0) return;
    Lobes f = v.value(light.wi);
    if (light.pdf > 0) {
      // Rays that gather find the same lights; the two share them by multiple importance sampling.
      if (v.apart) {
        f.diffuse *= misWeight(light.pdf, cosinePdf(v, light.wi));
        f.specular *= misWeight(light.pdf, v.bsdf.pdfSpecular(light.wi));
      } else {
        const float weight = misWeight(light.pdf, v.followed ? cosinePdf(v, light.wi) : v.bsdf.pdf(light.wi));
        f.diffuse *= weight, f.specular *= weight;
      }
    }
    const Lobes sum{f.diffuse * light.radiance, f.specular * light.radiance};
    if (!isBlack(sum.diffuse) || !isBlack(sum.specular)) w.shadow(v.estimate, v.first, shadowRay(offsetOrigin(v.s.p, v.s.ng), v.s.p, light), sum);
  };
  if (v.first) {
    if (sampleLamps_) take(lights_.sampleLamps(v.s.p, sampler));
  } else {
    if (lights_.lampCount() > 0) {
      const LightSample lamp = lights_.sampleLamps(v.s.p, sampler);
      if (!leavesToCache(v, lamp)) take(lamp);
    }
    for (size_t i = 0; i < lights_.sunCount(); ++i) take(lights_.sampleSun(i, sampler.next2()));
  }
  if (lights_.hasEmitters()) {
    const Vec2 u = sampler.next2();
    const LightSample light = lights_.sampleEmitters(v.s.p, u, sampler.next1());
    if (!leavesToCache(v, light)) take(light);
  }
  if (lights_.sky().present() && !v.skyKnown) {
    const Vec2 u = sampler.next2();
    take(sampleSkyGuided(field_.guide, v.guide, lights_, u, sampler.next1()));
  }
}

// Whether it lies in the surroundings of the lamp or emissive mesh sampled from there: what surfaces reflect of its light is in the
// cache and in LampGlow, and is not found a second time by paths that go on. Polished metal reflects emissive meshes as they are.
bool RayScatter::leavesToCache(const GatherVertex& v, const LightSample& light) const {
  if (!light.valid() || !v.leavesNear) return false;
  if (light.emitter >= 0) return !isPolishedMetal(*v.s.material) && besideEmitters_[static_cast<size_t>(light.emitter)].contains(v.s.p);
  return besideLamps_[static_cast<size_t>(light.lamp)].contains(v.s.p);
}

bool RayScatter::isCached(const GatherPath& path, uint32_t instance) const {
  const int32_t emitter = lights_.emitterOf(instance);
  return path.leavesNear && emitter >= 0 && besideEmitters_[static_cast<size_t>(emitter)].contains(path.from);
}

// Light that surfaces near lamps reflect, as far as gathering rays leave it to LampGlow's points.
void RayScatter::glowAt(const GatherVertex& v, GatherWork& w) const {
  const GlowSample g = field_.glow.sample(v.s.p, v.s.ns, 1, 0, w.samplers[v.estimate]);
  if (!g.light.valid() || dot(g.light.wi, v.s.ng) <= 0) return;
  const Vec3 wi = g.light.wi;
  Lobes f = v.value(wi);
  const float cosine = cosinePdf(v, wi), mixed = v.bsdf.pdf(wi);
  f.diffuse *= field_.glow.pointShare(g.point, v.s.p, {v.apart || v.followed ? cosine : mixed, 0});
  f.specular *= v.clear ? 0 : field_.glow.pointShare(g.point, v.s.p, {v.apart ? v.bsdf.pdfSpecular(wi) : mixed, 0});
  const Lobes sum{f.diffuse * g.light.radiance, f.specular * g.light.radiance};
  if (!isBlack(sum.diffuse) || !isBlack(sum.specular)) w.shadow(v.estimate, false, shadowRay(offsetOrigin(v.s.p, v.s.ng), v.s.p, g.light), sum);
}

void RayScatter::gatherAt(const GatherVertex& v, GatherWork& w) const {
  Sampler& sampler = w.samplers[v.estimate];
  const Vec3 origin = offsetOrigin(v.s.p, v.s.ng);
  const auto send = [&](Vec3 d, const Lobes& factor, float pdf, bool clear, float spread) {
    if (dot(d, v.s.ng) <= 0 || std::max(maxComponent(factor.diffuse), maxComponent(factor.specular)) < kNothing) return;
    w.next.push_back({{origin, d, 0, kInfinity}, factor, v.s.p, pdf, v.guide, v.estimate, static_cast<uint8_t>(v.depth + 1), 0, clear, v.skyKnown, v.leavesNear && !isPolishedMetal(*v.s.material), spread});
  };
  if (!v.first) {
    const Vec2 u = sampler.next2();
    const BsdfSample b = v.bsdf.sample(u, sampler.next1());
    if (!b.valid()) return;
    const float survive = std::clamp(maxComponent(b.weight), 0.05f, 1.0f);
    if (sampler.next1() >= survive) return;
    const Vec3 weight = b.weight / survive;
    return send(b.wi, {v.factor.diffuse * weight, v.factor.specular * weight}, b.mirror ? 0 : b.pdf, v.clear && b.mirror, v.clear && b.mirror ? 0 : kSpread);
  }
  const bool diffuseOnly = v.apart || v.followed;
  const Vec2 u = sampler.next2();
  if (!diffuseOnly) {
    const BsdfSample b = v.bsdf.sample(u, sampler.next1());
    if (b.valid() && !b.mirror) send(b.wi, {v.bsdf.evaluateDiffuse(b.wi) / b.pdf, v.bsdf.evaluateSpecular(b.wi) / b.pdf}, b.pdf, false, kSpread);
  } else if (!v.glossOnly && maxComponent(v.bsdf.diffuseAlbedo()) > kNothing) {
    const Vec3 local = sampleCosineHemisphere(u), d = Frame(v.s.ns).toWorld(local);
    const float pdf = std::max(local.z, 1e-6f) / kPi;
    send(d, {v.bsdf.evaluateDiffuse(d) / pdf, Vec3(0)}, pdf, false, kSpread);
  }
  if (v.apart && maxComponent(v.bsdf.specularAlbedo()) > kNothing) {
    const BsdfSample b = v.bsdf.sampleSpecular(sampler.next2());
    if (b.valid()) send(b.wi, {Vec3(0), b.weight}, b.mirror ? 0 : b.pdf, v.clear, v.clear ? 0 : std::min(kSpread, v.s.m.roughness));
  }
}

}  // namespace roomlight
