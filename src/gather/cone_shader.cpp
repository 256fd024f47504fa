#include "gather/cone_shader.h"

#include "base/sampling.h"
#include "gather/cone_march.h"
#include "radiance/sky_guide.h"
#include "trace/bsdf.h"
#include "trace/surface_point.h"

namespace roomlight {
namespace {

constexpr int kMostPanes = 16;
constexpr int kSkySamples = 2;
constexpr float kSharpRoughness = 0.1f;  // below: mirrors, whose pictures are seen clearly
constexpr float kChainRoughness = 0.3f;  // below: a reflection seen in a reflection is followed on
constexpr int kAllLamps = 8;  // up to this many lamps each gets its own shadow ray; more are chosen by importance

class Implementation {
 public:
  Implementation(const RayScene& rays, const Lights& lights, const Voxels& voxels, const RadianceField& field, const GatherSettings& settings)
      : rays_(rays), lights_(lights), voxels_(voxels), field_(field), settings_(settings),
        diffuse_{std::tan(settings.coneHalfAngleDeg * kPi / 180), settings.occlusionLambda} {}

  ConeSample primary(Ray ray, Sampler& sampler, ConeCounters& count) const {
    ConeSample out;
    Vec3 left(1);
    for (int pane = 0; pane < kMostPanes; ++pane) {
      const Hit hit = rays_.intersect(ray);
      ++count.rays;
      if (!hit.valid()) {
        out.rest += left * background(ray.direction);
        return out;
      }
      const SurfacePoint s = surfaceAt(rays_.scene(), hit, ray.direction);
      const Vec3 through = passing(s, ray.direction);
      // What stands behind a pane is what the picture shows there.
      if (luminance(through) < 0.5f && !out.surface) out.surface = true, out.normal = s.ns, out.position = s.p, out.roughness = s.m.roughness;
      shade(s, -ray.direction, left, sampler, count, out);
      left *= through;
      if (luminance(left) < 1e-3f) return out;
      ray.origin = offsetOrigin(s.p, -s.ng);
      ray.tMin = 0;
    }
    return out;
  }

 private:
  static Vec3 passing(const SurfacePoint& s, Vec3 d) {
    if (s.m.transmission <= 0 && s.m.alpha >= 1) return Vec3(0);
    return straightTransmittance(*s.material, s.m, std::abs(dot(s.ns, d)));
  }

  Vec3 background(Vec3 d) const {
    Vec3 sum = lights_.sky().present() ? lights_.sky().radiance(d) : Vec3(0);
    for (size_t i = 0; i < lights_.sunCount(); ++i) {
      float pdf;
      sum += lights_.sunDisc(i, d, pdf);
    }
    return sum;
  }

  // Light that the surface sends towards wo, without what passes straight through it.
  void shade(const SurfacePoint& s, Vec3 wo, Vec3 left, Sampler& sampler, ConeCounters& count, ConeSample& out) const {
    const Bsdf bsdf(s.m, s.ns, s.ng, wo);
    const bool rayReflection = s.m.roughness < settings_.rayRoughness;
    const int32_t guide = guideAt(field_.guide, voxels_, s.p, s.ng);
    Lobes light = direct(s, bsdf, rayReflection, guide, sampler, count);
    const Vec3 rho = bsdf.diffuseAlbedo();
    if (maxComponent(rho) > 1e-4f) light.diffuse += rho * indirect(s, sampler, count, out.occlusion);
    if (maxComponent(bsdf.specularAlbedo()) > 1e-4f) light.specular += reflection(s, bsdf, rayReflection, guide, sampler, count);
    left *= s.m.alpha;
    out.diffuse += left * light.diffuse;
    out.albedo += left * rho;
    out.specular += left * light.specular;
    out.rest += left * s.emitted() / std::max(s.m.alpha, 1e-6f);
  }

  // Light that leaves a surface, by the lobe that reflected it; or, before the light is multiplied in, the two lobes' values.
  struct Lobes {
    Vec3 diffuse, specular;
    void add(const Lobes& f, Vec3 light) { diffuse += f.diffuse * light, specular += f.specular * light; }
  };

  // What arrives of a light sample.
  Vec3 visible(const SurfacePoint& s, const LightSample& light, const Lobes& f, ConeCounters& count) const {
    if (isBlack(f.diffuse) && isBlack(f.specular)) return {};
    const float tMax = light.distance < kInfinity ? light.distance * (1 - 1e-4f) : kInfinity;
    ++count.rays;
    return light.radiance * rays_.transmittance({offsetOrigin(s.p, s.ng), light.wi, 0, tMax});
  }

  // Direct light by exact shadow rays. Where reflections follow rays they find extended lights too; both ways share the
  // specular lobe by multiple importance sampling. `strategies` is how many light samples compete.
  Lobes direct(const SurfacePoint& s, const Bsdf& bsdf, bool rayReflection, int32_t guide, Sampler& sampler, ConeCounters& count) const {
    Lobes sum;
    const auto take = [&](const LightSample& light, float strategies, float weight) {
      if (!light.valid()) return;
      Lobes f{bsdf.evaluateDiffuse(light.wi), bsdf.evaluateSpecular(light.wi)};
      if (rayReflection && light.pdf > 0) f.specular *= misWeight(strategies * light.pdf, bsdf.pdfSpecular(light.wi));
      sum.add(f, visible(s, light, f, count) * weight);
    };
    const size_t lamps = lights_.lampCount();
    if (lamps > 0 && lamps <= kAllLamps) {
      for (size_t i = 0; i < lamps; ++i) take(lights_.sampleLamp(i, s.p), 1, 1);
    } else if (lamps > 0) {
      for (int k = 0; k < 2; ++k) take(lights_.sampleLamps(s.p, sampler.next1()), 1, 0.5f);
    }
    if (lights_.hasEmitters()) {
      const Vec2 u = sampler.next2();
      take(lights_.sampleEmitters(s.p, u, sampler.next1()), 1, 1);
    }
    for (size_t i = 0; i < lights_.sunCount(); ++i) take(lights_.sampleSun(i, sampler.next2()), 1, 1);
    if (lights_.sky().present()) {
      for (int k = 0; k < kSkySamples; ++k) {
        const Vec2 u = sampler.next2();
        take(sampleSkyGuided(field_.guide, guide, lights_, u, sampler.next1()), kSkySamples, 1.0f / kSkySamples);
      }
    }
    return sum;
  }

  ConeStart coneStart(const SurfacePoint& s) const {
    return {s.p + s.ng * (settings_.startOffsetVoxels * voxels_.voxelSizeM), s.ng};
  }

  // Mean radiance over the cosine-weighted hemisphere, by cones.
  Vec3 indirect(const SurfacePoint& s, Sampler& sampler, ConeCounters& count, float& occlusion) const {
    const Frame frame(s.ns);
    const ConeStart start = coneStart(s);
    Vec3 sum;
    const int n = settings_.conesPerSample;
    const Vec2 u = sampler.next2();
    for (int i = 0; i < n; ++i) {
      // Strata of azimuth within the sample; the sampler spreads the samples of a pixel.
      const Vec2 stratum{u.x, u.y};
      Vec3 local = sampleCosineHemisphere({stratum.x, stratum.y});
      const float turn = 2 * kPi * static_cast<float>(i) / static_cast<float>(n);
      local = {local.x * std::cos(turn) - local.y * std::sin(turn), local.x * std::sin(turn) + local.y * std::cos(turn), local.z};
      Vec3 d = frame.toWorld(local);
      if (dot(d, s.ng) < 0.02f) d = normalize(d + s.ng * (0.04f - dot(d, s.ng)));
      const ConeLight c = marchCone(field_, start, d, diffuse_, sampler.next1());
      sum += c.radiance + settings_.ambientCdM2 * (1 - c.occlusion);
      occlusion += c.occlusion / static_cast<float>(n);
    }
    count.cones += static_cast<uint64_t>(n);
    return sum / static_cast<float>(n);
  }

  Vec3 reflection(const SurfacePoint& s, const Bsdf& bsdf, bool byRay, int32_t guide, Sampler& sampler, ConeCounters& count) const {
    const BsdfSample r = bsdf.sampleSpecular(sampler.next2());
    if (!r.valid() || isBlack(r.weight)) return {};
    if (byRay) return r.weight * along({offsetOrigin(s.p, s.ng), r.wi, 0, kInfinity}, {s.p, r.mirror ? 0 : r.pdf, guide, s.m.roughness < kSharpRoughness}, sampler, count);
    // The lobe is sampled, so the cone need only be as wide as the gaps between the samples.
    const ConeShape shape{0.5f * s.m.roughness * s.m.roughness, 0};
    ++count.cones;
    return r.weight * marchCone(field_, coneStart(s), r.wi, shape, sampler.next1()).radiance;
  }

  // Where a reflected ray started, and the density with which its direction was chosen; 0: nothing else looked for lights there.
  struct Reflected {
    Vec3 p;
    float pdf;
    int32_t guide;
    bool sharp;  // what it meets is seen clearly, and is lit with the care of what the camera sees
    float weight(float lightPdf) const { return pdf > 0 ? misWeight(pdf, lightPdf) : 1; }
  };

  // What an exact ray sees: lights as they are, surfaces by their own materials under the light that voxels hold. Where the way
  // goes on, through a pane or as a further reflection, one of the two is followed, in proportion to its light.
  Vec3 along(Ray ray, Reflected from, Sampler& sampler, ConeCounters& count) const {
    Vec3 sum, left(1);
    for (int k = 0; k < kMostPanes; ++k) {
      const Hit hit = rays_.intersect(ray);
      ++count.rays;
      if (!hit.valid()) return sum + left * reflectedBackground(ray.direction, from);
      const SurfacePoint s = surfaceAt(rays_.scene(), hit, ray.direction);
      if (const Vec3 emitted = s.emitted(); !isBlack(emitted)) sum += left * emitted * from.weight(lights_.pdfEmitters(from.p, s));
      const Bsdf bsdf(s.m, s.ns, s.ng, -ray.direction);
      const bool glossy = s.m.roughness < kChainRoughness;
      const Vec3 rho = glossy ? bsdf.diffuseAlbedo() : bihemisphericalAlbedo(s.m);
      const int32_t guide = from.sharp ? guideAt(field_.guide, voxels_, s.p, s.ng) : -1;
      if (from.sharp) {
        float unused = 0;
        const Lobes light = direct(s, bsdf, glossy, guide, sampler, count);
        Vec3 lit = light.diffuse + light.specular;
        if (maxComponent(rho) > 1e-4f) lit += rho * indirect(s, sampler, count, unused);
        sum += left * lit * s.m.alpha;
      } else {
        sum += left * rho * irradiance(s, sampler) * (s.m.alpha / kPi);
      }
      const Vec3 through = passing(s, ray.direction), mirrored = glossy ? bsdf.specularAlbedo() * s.m.alpha : Vec3(0);
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

  Vec3 reflectedBackground(Vec3 d, const Reflected& from) const {
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

  // From the slots around s, chosen at random with the weights of a tent, so that many look-ups show no edges of voxels.
  Vec3 irradiance(const SurfacePoint& s, Sampler& sampler) const {
    const Frame frame(s.ng);
    const Vec2 u = sampler.next2();
    const float h = voxels_.voxelSizeM;
    const int64_t near = slotAtSurface(voxels_, s.p + (frame.t * (u.x - 0.5f) + frame.b * (u.y - 0.5f)) * h, s.ng);
    const auto onSameSurface = [&](int64_t slot) {
      const FaceSlot& f = voxels_.slots[static_cast<size_t>(slot)];
      return dot(f.normal, s.ng) > 0.8f && std::abs(dot(f.position - s.p, s.ng)) < 0.3f * h;
    };
    const int64_t slot = near >= 0 && onSameSurface(near) ? near : slotAtSurface(voxels_, s.p, s.ng);
    return slot < 0 ? Vec3(0) : field_.irradianceLux[static_cast<size_t>(slot)];
  }

  const RayScene& rays_;
  const Lights& lights_;
  const Voxels& voxels_;
  const RadianceField& field_;
  const GatherSettings& settings_;
  const ConeShape diffuse_;
};

}  // namespace

ConeSample ConeShader::sample(const Ray& ray, Sampler& sampler, ConeCounters& count) const {
  return Implementation(rays_, lights_, voxels_, field_, settings_).primary(ray, sampler, count);
}

}  // namespace roomlight
