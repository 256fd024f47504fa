#include "gather/direct_shader.h"

#include "base/sampling.h"
#include "radiance/sky_guide.h"
#include "trace/traced_scene.h"

namespace roomlight {
namespace {

constexpr int kMostPanes = 16;
constexpr int kGuidedSkySamples = 2;
constexpr int kEmitterSamples = 2;
constexpr float kSharpRoughness = 0.1f;  // below: mirrors, whose pictures are seen clearly
constexpr float kChainRoughness = 0.3f;  // below: a reflection seen in a reflection is followed on
constexpr int kLampSamples = 2;  // where lamps are many

}  // namespace

float DirectShader::Reflected::weight(float lightPdf) const { return pdf > 0 ? misWeight(pdf, lightPdf) : 1; }

void DirectShader::shade(std::span<const Shading> work, std::span<const Shadow> shadows, std::span<SurfaceLight> light,
                         GatherCounters& count) const {
  for (size_t i = 0; i < work.size(); ++i)
    light[i] = shade(work[i], shadows.subspan(work[i].firstShadow, sharp_.count()), count);
}

SurfaceLight DirectShader::shade(const Shading& work, std::span<const Shadow> shadows, GatherCounters& count) const {
  const SurfacePoint& s = work.s;
  Sampler sampler = work.sampler;
  const Bsdf bsdf(s.m, s.ns, s.ng, work.wo);
  const Reflection by = work.followed                   ? Reflection::Followed
                        : s.m.roughness < rayRoughness_ ? Reflection::Ray
                                                        : Reflection::Cone;
  const LitSurface at{s, bsdf, by};
  const int32_t guide = guideOf(s);
  SurfaceLight out;
  const Lobes soft = this->soft(at, guide, sampler, count, !work.skyKnown),
              sharp = this->sharp(at, shadows, sampler, count, out.sharpVariance);
  out.albedo = bsdf.diffuseAlbedo();
  out.diffuse = soft.diffuse;
  out.sharp = sharp.diffuse;
  out.specular = soft.specular + sharp.specular;
  if (maxComponent(out.albedo) > 1e-4f) out.diffuse += out.albedo * indirect(s, sampler, count, out.occlusion);
  if (!work.followed && maxComponent(bsdf.specularAlbedo()) > 1e-4f)
    out.specular += reflection(at, work.wo, guide, sampler, count);
  return out;
}

// What arrives of a light sample.
Vec3 DirectShader::visible(const SurfacePoint& s, const LightSample& light, const Lobes& f,
                           GatherCounters& count) const {
  if (isBlack(f.diffuse) && isBlack(f.specular)) return {};
  ++count.rays;
  return rays_.transmittance(shadowRay(offsetOrigin(s.p, s.ng), s.p, light));
}

// Both lobes towards a light. Where reflections follow rays they find extended lights too; both ways share the specular
// lobe by multiple importance sampling, and from mirrors rays alone look for them. `strategies` is how many light
// samples compete.
Lobes DirectShader::towards(const LightSample& light, const LitSurface& at, float strategies) const {
  if (!light.valid()) return {};
  Lobes f{at.bsdf.evaluateDiffuse(light.wi), at.bsdf.evaluateSpecular(light.wi)};
  if (at.by == Reflection::Ray && light.pdf > 0)
    f.specular *= misWeight(strategies * light.pdf, at.bsdf.pdfSpecular(light.wi));
  if (at.by == Reflection::Followed && light.pdf > 0) f.specular = {};
  return f;
}

// Light of suns and lamps. Their shadows are given, or traced where `shadows` is empty.
Lobes DirectShader::sharp(const LitSurface& at, std::span<const Shadow> shadows, Sampler& sampler,
                          GatherCounters& count, float& variance) const {
  Lobes sum;
  for (size_t i = 0; i < sharp_.count(); ++i) {
    const LightSample light = sharp_.sample(i, at.s.p, sampler.next2());
    const Lobes f = towards(light, at, 1);
    if (shadows.empty()) {
      sum.add(f, light.radiance * visible(at.s, light, f, count));
    } else {
      sum.add(f, light.radiance * shadows[i].left);
      const float l = luminance(f.diffuse * light.radiance);
      variance += l * l * shadows[i].variance;
    }
  }
  return sum;
}

// Light of the sky, emissive meshes and, where they are many, lamps.
Lobes DirectShader::soft(const LitSurface& at, int32_t guide, Sampler& sampler, GatherCounters& count,
                         bool skyToo) const {
  Lobes sum;
  const auto take = [&](const LightSample& light, float strategies, float weight) {
    const Lobes f = towards(light, at, strategies);
    sum.add(f, light.radiance * visible(at.s, light, f, count) * weight);
  };
  if (lights_.lampCount() + lights_.sunCount() > sharp_.count()) {
    for (int k = 0; k < kLampSamples; ++k) take(lights_.sampleLamps(at.s.p, sampler), 1, 1.0f / kLampSamples);
  }
  if (lights_.hasEmitters()) {
    const float choice = sampler.next1();
    for (int k = 0; k < kEmitterSamples; ++k) {
      take(lights_.sampleEmitters(at.s.p, sampler.next2(), (choice + static_cast<float>(k)) / kEmitterSamples),
           kEmitterSamples, 1.0f / kEmitterSamples);
    }
  }
  if (skyToo && lights_.sky().present()) {
    for (int k = 0; k < kGuidedSkySamples; ++k) {
      const Vec2 u = sampler.next2();
      take(sampleSkyGuided(guide_, guide, lights_, u, sampler.next1()), kGuidedSkySamples, 1.0f / kGuidedSkySamples);
    }
  }
  addNear(at.s, at.bsdf, at.by, sampler, sum, count);
  return sum;
}

Vec3 DirectShader::reflection(const LitSurface& at, Vec3 wo, int32_t guide, Sampler& sampler,
                              GatherCounters& count) const {
  const SurfacePoint& s = at.s;
  const BsdfSample r = at.bsdf.sampleSpecular(sampler.next2());
  if (!r.valid() || isBlack(r.weight)) return {};
  if (at.by == Reflection::Ray)
    return r.weight * along({offsetOrigin(s.p, s.ng), r.wi, 0, kInfinity},
                            {s.p, r.mirror ? 0 : r.pdf, guide, s.m.roughness < kSharpRoughness}, sampler, count);
  return r.weight * glossy(s, wo, r, sampler, count);
}

// What an exact ray sees: lights as they are, surfaces by their own materials under the light that voxels hold. Where
// the way goes on, through a pane or as a further reflection, one of the two is followed, in proportion to its light.
Vec3 DirectShader::along(Ray ray, Reflected from, Sampler& sampler, GatherCounters& count) const {
  Vec3 sum, left(1);
  for (int k = 0; k < kMostPanes; ++k) {
    const Hit hit = rays_.intersect(ray);
    ++count.rays;
    if (!hit.valid()) return sum + left * reflectedBackground(ray.direction, from);
    const SurfacePoint s = surfaceAt(rays_.scene(), hit, ray.direction);
    if (const Vec3 emitted = s.emitted(); !isBlack(emitted))
      sum += left * emitted * from.weight(kEmitterSamples * lights_.pdfEmitters(from.p, s));
    const Bsdf bsdf(s.m, s.ns, s.ng, -ray.direction);
    const bool glossy = s.m.roughness < kChainRoughness;
    const LitSurface at{s, bsdf, glossy ? Reflection::Ray : Reflection::Cone};
    const Vec3 rho = glossy ? bsdf.diffuseAlbedo() : bihemisphericalAlbedo(s.m);
    const int32_t guide = from.sharp ? guideOf(s) : -1;
    if (from.sharp) {
      float unused = 0;
      const Lobes light = soft(at, guide, sampler, count), point = sharp(at, {}, sampler, count, unused);
      Vec3 lit = light.diffuse + light.specular + point.diffuse + point.specular;
      if (maxComponent(rho) > 1e-4f) lit += rho * indirect(s, sampler, count, unused);
      sum += left * lit * s.m.alpha;
    } else {
      sum += left * rho * reflectedIrradiance(s, ray.direction, from, sampler, count) * (s.m.alpha / kPi);
    }
    const Vec3 through = passing(s.m, *s.material, std::abs(dot(s.ns, ray.direction))),
               mirrored = glossy ? bsdf.specularAlbedo() * s.m.alpha : Vec3(0);
    const float pThrough = luminance(left * through), pMirrored = luminance(left * mirrored),
                survive = std::min(1.0f, 2 * (pThrough + pMirrored));
    if (survive < 1e-2f) return sum;
    const float u = sampler.next1(), split = survive * pThrough / (pThrough + pMirrored);
    if (u >= survive) return sum;
    if (u < split) {
      left *= through / split;
      ray.origin = offsetOrigin(s.p, -s.ng);
      continue;
    }
    const BsdfSample r = bsdf.sampleSpecular(sampler.next2());
    if (!r.valid()) return sum;
    left *= r.weight * (s.m.alpha / (survive - split));
    from = {s.p, from.sharp && !r.mirror ? r.pdf : 0, guide, from.sharp};
    ray = {offsetOrigin(s.p, s.ng), r.wi, 0, kInfinity};
  }
  return sum;
}

Vec3 DirectShader::reflectedBackground(Vec3 d, const Reflected& from) const {
  Vec3 sum;
  if (lights_.sky().present()) {
    sum += lights_.sky().radiance(d) * from.weight(kGuidedSkySamples * pdfSkyGuided(guide_, from.guide, lights_, d));
  }
  for (size_t i = 0; i < lights_.sunCount(); ++i) {
    float pdf;
    const Vec3 disc = lights_.sunDisc(i, d, pdf);
    if (pdf > 0) sum += disc * from.weight(pdf);
  }
  return sum;
}

Vec3 DirectShader::reflectedIrradiance(const SurfacePoint& s, Vec3 direction, const Reflected&, Sampler& sampler,
                                       GatherCounters& count) const {
  SurfacePoint white = s;
  white.m = {};
  white.m.baseColor = Vec3(1);
  const Bsdf bsdf(white.m, s.ns, s.ng, -direction);
  const LitSurface at{white, bsdf, Reflection::Cone};
  float unused = 0;
  const Vec3 direct = soft(at, guideOf(s), sampler, count).diffuse + sharp(at, {}, sampler, count, unused).diffuse;
  return (direct + indirect(white, sampler, count, unused)) * kPi;
}

void DirectShader::addNear(const SurfacePoint&, const Bsdf&, Reflection, Sampler&, Lobes&, GatherCounters&) const {}

int32_t DirectShader::guideOf(const SurfacePoint& s) const { return guideAt(guide_, voxels_, s.p, s.ng); }

}  // namespace roomlight
