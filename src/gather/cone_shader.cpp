#include "gather/cone_shader.h"

#include "base/sampling.h"
#include "radiance/sky_guide.h"
#include "trace/shadow_ray.h"

namespace roomlight {
namespace {

constexpr int kMostPanes = 16;
constexpr int kSkySamples = 2;
constexpr int kEmitterSamples = 2;
constexpr float kSharpRoughness = 0.1f;  // below: mirrors, whose pictures are seen clearly
constexpr float kChainRoughness = 0.3f;  // below: a reflection seen in a reflection is followed on
constexpr int kLampSamples = 2;  // where lamps are many
constexpr float kLift = 0.1f;    // voxels: for places to see one another along a bent surface
constexpr float kDoubt = 8;      // times the mean around: where rays check what cones find

}  // namespace

float ConeShader::Reflected::weight(float lightPdf) const { return pdf > 0 ? misWeight(pdf, lightPdf) : 1; }

ConeShader::ConeShader(const RayScene& rays, const Lights& lights, const Voxels& voxels, const RadianceField& field, const GatherSettings& settings)
    : rays_(rays), lights_(lights), voxels_(voxels), field_(field), settings_(settings), sharp_(rays, lights), diffuse_{std::tan(settings.coneHalfAngleDeg * kPi / 180), settings.occlusionLambda} {}

void ConeShader::shade(std::span<const Shading> work, std::span<const Shadow> shadows, std::span<SurfaceLight> light, GatherCounters& count) const {
  for (size_t i = 0; i < work.size(); ++i) light[i] = shade(work[i], shadows.subspan(work[i].firstShadow, sharp_.count()), count);
}

SurfaceLight ConeShader::shade(const Shading& work, std::span<const Shadow> shadows, GatherCounters& count) const {
  const SurfacePoint& s = work.s;
  Sampler sampler = work.sampler;
  const Bsdf bsdf(s.m, s.ns, s.ng, work.wo);
  const Reflection by = work.followed ? Reflection::Followed : s.m.roughness < settings_.rayRoughness ? Reflection::Ray
                                                                                                      : Reflection::Cone;
  const int32_t guide = guideAt(field_.guide, voxels_, s.p, s.ng);
  SurfaceLight out;
  const Lobes soft = this->soft(s, bsdf, by, guide, sampler, count, !work.skyKnown), sharp = this->sharp(s, bsdf, by, shadows, sampler, count, out.sharpVariance);
  out.albedo = bsdf.diffuseAlbedo();
  out.diffuse = soft.diffuse;
  out.sharp = sharp.diffuse;
  out.specular = soft.specular + sharp.specular;
  if (maxComponent(out.albedo) > 1e-4f) out.diffuse += out.albedo * indirect(s, sampler, count, out.occlusion);
  if (!work.followed && maxComponent(bsdf.specularAlbedo()) > 1e-4f) out.specular += reflection(s, bsdf, by, guide, sampler, count);
  return out;
}

// What arrives of a light sample.
Vec3 ConeShader::visible(const SurfacePoint& s, const LightSample& light, const Lobes& f, GatherCounters& count) const {
  if (isBlack(f.diffuse) && isBlack(f.specular)) return {};
  ++count.rays;
  return rays_.transmittance(shadowRay(offsetOrigin(s.p, s.ng), s.p, light));
}

// Both lobes towards a light. Where reflections follow rays they find extended lights too; both ways share the specular lobe
// by multiple importance sampling, and from mirrors rays alone look for them. `strategies` is how many light samples compete.
Lobes ConeShader::towards(const LightSample& light, const Bsdf& bsdf, Reflection by, float strategies) const {
  if (!light.valid()) return {};
  Lobes f{bsdf.evaluateDiffuse(light.wi), bsdf.evaluateSpecular(light.wi)};
  if (by == Reflection::Ray && light.pdf > 0) f.specular *= misWeight(strategies * light.pdf, bsdf.pdfSpecular(light.wi));
  if (by == Reflection::Followed && light.pdf > 0) f.specular = {};
  return f;
}

// Light of suns and lamps. Their shadows are given, or traced where `shadows` is empty.
Lobes ConeShader::sharp(const SurfacePoint& s, const Bsdf& bsdf, Reflection by, std::span<const Shadow> shadows, Sampler& sampler, GatherCounters& count,
                        float& variance) const {
  Lobes sum;
  for (size_t i = 0; i < sharp_.count(); ++i) {
    const LightSample light = sharp_.sample(i, s.p, sampler.next2());
    const Lobes f = towards(light, bsdf, by, 1);
    if (shadows.empty()) {
      sum.add(f, light.radiance * visible(s, light, f, count));
    } else {
      sum.add(f, light.radiance * shadows[i].left);
      const float l = luminance(f.diffuse * light.radiance);
      variance += l * l * shadows[i].variance;
    }
  }
  return sum;
}

// Light of the sky, emissive meshes and, where they are many, lamps.
Lobes ConeShader::soft(const SurfacePoint& s, const Bsdf& bsdf, Reflection by, int32_t guide, Sampler& sampler, GatherCounters& count, bool skyToo) const {
  Lobes sum;
  const auto take = [&](const LightSample& light, float strategies, float weight) {
    const Lobes f = towards(light, bsdf, by, strategies);
    sum.add(f, light.radiance * visible(s, light, f, count) * weight);
  };
  if (lights_.lampCount() + lights_.sunCount() > sharp_.count()) {
    for (int k = 0; k < kLampSamples; ++k) take(lights_.sampleLamps(s.p, sampler), 1, 1.0f / kLampSamples);
  }
  if (lights_.hasEmitters()) {
    const float choice = sampler.next1();
    for (int k = 0; k < kEmitterSamples; ++k) {
      take(lights_.sampleEmitters(s.p, sampler.next2(), (choice + static_cast<float>(k)) / kEmitterSamples), kEmitterSamples, 1.0f / kEmitterSamples);
    }
  }
  if (skyToo && lights_.sky().present()) {
    for (int k = 0; k < kSkySamples; ++k) {
      const Vec2 u = sampler.next2();
      take(sampleSkyGuided(field_.guide, guide, lights_, u, sampler.next1()), kSkySamples, 1.0f / kSkySamples);
    }
  }
  if (!field_.glow.empty()) glow(s, bsdf, by, sampler, sum, count);
  return sum;
}

// Light that surfaces near lamps reflect, as far as cones leave it.
void ConeShader::glow(const SurfacePoint& s, const Bsdf& bsdf, Reflection by, Sampler& sampler, Lobes& sum, GatherCounters& count) const {
  const GlowSample g = field_.glow.sample(s.p, s.ns, static_cast<float>(settings_.conesPerShading), diffuse_.tanHalf, sampler);
  if (!g.light.valid()) return;
  const Vec3 wi = g.light.wi;
  Lobes f{bsdf.evaluateDiffuse(wi), {}};
  f.diffuse *= field_.glow.pointShare(g.point, s.p, {conePdf(dot(wi, s.ns)), std::min(diffuse_.tanHalf, dot(wi, s.ng))});
  if (s.m.roughness >= kSharpRoughness) {
    const ConeShape shape = lobe(s, bsdf.pdfSpecular(wi));
    f.specular = bsdf.evaluateSpecular(wi) * field_.glow.pointShare(g.point, s.p, {shape.pdf, by == Reflection::Ray ? 0 : std::min(shape.tanHalf, dot(wi, s.ng))});
  }
  sum.add(f, g.light.radiance * visible(s, g.light, f, count));
}

// Of all diffuse cones of a shading together.
float ConeShader::conePdf(float cosSurface) const { return static_cast<float>(settings_.conesPerShading) * std::max(0.0f, cosSurface) / kPi; }

// A cone of the glossy lobe. The lobe is sampled, so the cone need only be as wide as the gaps between the samples.
ConeShape ConeShader::lobe(const SurfacePoint& s, float pdf) const { return {std::min(0.5f * s.m.roughness * s.m.roughness, diffuse_.tanHalf), 0, pdf}; }

ConeStart ConeShader::coneStart(const SurfacePoint& s) const {
  return {s.p + s.ng * (settings_.startOffsetVoxels * voxels_.voxelSizeM), s.ng};
}

// Mean radiance over the cosine-weighted hemisphere, by cones.
Vec3 ConeShader::indirect(const SurfacePoint& s, Sampler& sampler, GatherCounters& count, float& occlusion) const {
  const Frame frame(s.ns);
  const ConeStart start = coneStart(s);
  const int64_t slot = slotAtSurface(voxels_, s.p, s.ng);
  const Vec3 irradiance = slot < 0 ? Vec3(0) : field_.irradianceLux[static_cast<size_t>(slot)];
  const float doubt = slot < 0 ? kInfinity : kDoubt * luminance(irradiance) / kPi;
  Vec3 sum;
  const int n = settings_.conesPerShading;
  const Vec3 first = sampleCosineHemisphere(sampler.next2());
  for (int i = 0; i < n; ++i) {
    // Turned about the normal: strata of azimuth within the shading; the sampler spreads the shadings of a pixel.
    const float turn = 2 * kPi * static_cast<float>(i) / static_cast<float>(n);
    Vec3 d = frame.toWorld({first.x * std::cos(turn) - first.y * std::sin(turn), first.x * std::sin(turn) + first.y * std::cos(turn), first.z});
    if (dot(d, s.ng) < 0.02f) d = normalize(d + s.ng * (0.04f - dot(d, s.ng)));
    ConeShape shape = diffuse_;
    shape.pdf = conePdf(dot(d, s.ns));
    const ConeLight c = marchCone(field_, start, d, shape, sampler.next1());
    sum += luminance(c.radiance) > doubt ? seen({offsetOrigin(s.p, s.ng), d, 0, kInfinity}, {s.p, shape.pdf, -1, false}, irradiance, sampler, count) : c.radiance;
    sum += settings_.ambientCdM2 * (1 - c.occlusion);
    occlusion += c.occlusion / static_cast<float>(n);
  }
  count.cones += static_cast<uint64_t>(n);
  return sum / static_cast<float>(n);
}

// What an exact ray sees by the light that voxels hold, without lights and sky: it tells whether a cone that found much more light than
// its surroundings get looked through a wall thinner than voxels. Where a slot does not stand for the place met (a bar that goes
// on through a wall has sun on one end of it), that is lit afresh, and what others reflect there is taken for that of the ray's start.
Vec3 ConeShader::seen(Ray ray, const Reflected& from, Vec3 startLux, Sampler& sampler, GatherCounters& count) const {
  Vec3 sum, left(1);
  for (int k = 0; k < kMostPanes && maxComponent(left) > 1e-3f; ++k) {
    const Hit hit = rays_.intersect(ray);
    ++count.rays;
    if (!hit.valid()) break;
    const SurfacePoint s = surfaceAt(rays_.scene(), hit, ray.direction);
    if (const int64_t slot = slotAtSurface(voxels_, s.p, s.ng); slot >= 0 && isParted(static_cast<size_t>(slot), s, count)) {
      const Bsdf bsdf(s.m, s.ns, s.ng, -ray.direction);
      float unused = 0;
      const Vec3 direct = soft(s, bsdf, Reflection::Cone, guideAt(field_.guide, voxels_, s.p, s.ng), sampler, count).diffuse + sharp(s, bsdf, Reflection::Cone, {}, sampler, count, unused).diffuse;
      sum += left * (direct + bsdf.diffuseAlbedo() * startLux / kPi) * s.m.alpha;
    } else {
      sum += left * bihemisphericalAlbedo(s.m) * reflectedIrradiance(s, ray.direction, from, sampler) * (s.m.alpha / kPi);
    }
    left *= passing(s.m, *s.material, std::abs(dot(s.ns, ray.direction)));
    ray.origin = offsetOrigin(s.p, -s.ng);
  }
  return sum;
}

// Whether another surface stands between a place and where its slot takes its light.
bool ConeShader::isParted(size_t slot, const SurfacePoint& s, GatherCounters& count) const {
  const Vec3 from = s.p + s.ng * (kLift * voxels_.voxelSizeM), to = voxels_.slots[slot].position + s.ng * (kLift * voxels_.voxelSizeM);
  ++count.rays;
  return luminance(rays_.transmittance({from, to - from, 0, 1})) < 0.25f;
}

Vec3 ConeShader::reflection(const SurfacePoint& s, const Bsdf& bsdf, Reflection by, int32_t guide, Sampler& sampler, GatherCounters& count) const {
  const BsdfSample r = bsdf.sampleSpecular(sampler.next2());
  if (!r.valid() || isBlack(r.weight)) return {};
  if (by == Reflection::Ray) return r.weight * along({offsetOrigin(s.p, s.ng), r.wi, 0, kInfinity}, {s.p, r.mirror ? 0 : r.pdf, guide, s.m.roughness < kSharpRoughness}, sampler, count);
  ++count.cones;
  return r.weight * marchCone(field_, coneStart(s), r.wi, lobe(s, r.pdf), sampler.next1()).radiance;
}

// What an exact ray sees: lights as they are, surfaces by their own materials under the light that voxels hold. Where the way
// goes on, through a pane or as a further reflection, one of the two is followed, in proportion to its light.
Vec3 ConeShader::along(Ray ray, Reflected from, Sampler& sampler, GatherCounters& count) const {
  Vec3 sum, left(1);
  for (int k = 0; k < kMostPanes; ++k) {
    const Hit hit = rays_.intersect(ray);
    ++count.rays;
    if (!hit.valid()) return sum + left * reflectedBackground(ray.direction, from);
    const SurfacePoint s = surfaceAt(rays_.scene(), hit, ray.direction);
    if (const Vec3 emitted = s.emitted(); !isBlack(emitted)) sum += left * emitted * from.weight(kEmitterSamples * lights_.pdfEmitters(from.p, s));
    const Bsdf bsdf(s.m, s.ns, s.ng, -ray.direction);
    const bool glossy = s.m.roughness < kChainRoughness;
    const Reflection by = glossy ? Reflection::Ray : Reflection::Cone;
    const Vec3 rho = glossy ? bsdf.diffuseAlbedo() : bihemisphericalAlbedo(s.m);
    const int32_t guide = from.sharp ? guideAt(field_.guide, voxels_, s.p, s.ng) : -1;
    if (from.sharp) {
      float unused = 0;
      const Lobes light = soft(s, bsdf, by, guide, sampler, count), point = sharp(s, bsdf, by, {}, sampler, count, unused);
      Vec3 lit = light.diffuse + light.specular + point.diffuse + point.specular;
      if (maxComponent(rho) > 1e-4f) lit += rho * indirect(s, sampler, count, unused);
      sum += left * lit * s.m.alpha;
    } else {
      sum += left * rho * reflectedIrradiance(s, ray.direction, from, sampler) * (s.m.alpha / kPi);
    }
    const Vec3 through = passing(s.m, *s.material, std::abs(dot(s.ns, ray.direction))), mirrored = glossy ? bsdf.specularAlbedo() * s.m.alpha : Vec3(0);
    const float pThrough = luminance(left * through), pMirrored = luminance(left * mirrored), survive = std::min(1.0f, 2 * (pThrough + pMirrored));
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

Vec3 ConeShader::reflectedBackground(Vec3 d, const Reflected& from) const {
  Vec3 sum;
  if (lights_.sky().present()) {
    sum += lights_.sky().radiance(d) * from.weight(kSkySamples * pdfSkyGuided(field_.guide, from.guide, lights_, d));
  }
  for (size_t i = 0; i < lights_.sunCount(); ++i) {
    float pdf;
    const Vec3 disc = lights_.sunDisc(i, d, pdf);
    if (pdf > 0) sum += disc * from.weight(pdf);
  }
  return sum;
}

// At s, where a ray reflected at from.p arrives. What the points of LampGlow give is left to them.
Vec3 ConeShader::reflectedIrradiance(const SurfacePoint& s, Vec3 direction, const Reflected& from, Sampler& sampler) const {
  const int64_t near = slotNear(s, sampler);
  if (near < 0) return {};
  const auto slot = static_cast<size_t>(near);
  const Vec3 lux = field_.irradianceLux[slot];
  if (from.pdf == 0 || field_.glow.empty() || field_.glowShare[slot] == 0) return lux;
  const float share = field_.glowShare[slot], glow = share * luminance(lux * voxels_.slots[slot].albedo) / kPi;
  return lux * (1 - share * (1 - field_.glow.coneShare(glow, length(s.p - from.p), -dot(s.ng, direction), from.pdf)));
}

// Among the slots around s, chosen at random with the weights of a tent, so that many look-ups show no edges of voxels.
int64_t ConeShader::slotNear(const SurfacePoint& s, Sampler& sampler) const {
  const Frame frame(s.ng);
  const Vec2 u = sampler.next2();
  const float h = voxels_.voxelSizeM;
  const int64_t near = slotAtSurface(voxels_, s.p + (frame.t * (u.x - 0.5f) + frame.b * (u.y - 0.5f)) * h, s.ng);
  const auto onSameSurface = [&](int64_t slot) {
    const FaceSlot& f = voxels_.slots[static_cast<size_t>(slot)];
    return dot(f.normal, s.ng) > 0.8f && std::abs(dot(f.position - s.p, s.ng)) < 0.3f * h;
  };
  return near >= 0 && onSameSurface(near) ? near : slotAtSurface(voxels_, s.p, s.ng);
}

}  // namespace roomlight
