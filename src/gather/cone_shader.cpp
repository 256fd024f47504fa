#include "gather/cone_gather.h"

#include "base/sampling.h"
#include "radiance/slot_lookup.h"

namespace roomlight {
namespace {

constexpr int kMostPanes = 16;
constexpr float kSharpRoughness = 0.1f;  // below: mirrors, in which glow is no light of its own
constexpr float kLift = 0.1f;    // voxels: for places to see one another along a bent surface
constexpr float kDoubt = 8;      // times the mean around: where rays check what cones find

}  // namespace

ConeShader::ConeShader(const RayScene& rays, const Lights& lights, const Voxels& voxels, const RadianceField& field,
                       const ConeGatherSettings& settings)
    : DirectShader(rays, lights, voxels, field.guide, settings.rayRoughness),
      field_(field),
      settings_(settings),
      diffuse_{std::tan(settings.coneHalfAngleDeg * kPi / 180), settings.occlusionLambda} {}

// Light that surfaces near lamps reflect, as far as cones leave it.
void ConeShader::addNear(const SurfacePoint& s, const Bsdf& bsdf, Reflection by, Sampler& sampler, Lobes& sum,
                         GatherCounters& count) const {
  if (field_.glow.empty()) return;
  const GlowSample g =
      field_.glow.sample(s.p, s.ns, static_cast<float>(settings_.conesPerShading), diffuse_.tanHalf, sampler);
  if (!g.light.valid()) return;
  const Vec3 wi = g.light.wi;
  Lobes f{bsdf.evaluateDiffuse(wi), {}};
  f.diffuse *=
      field_.glow.pointShare(g.point, s.p, {conePdf(dot(wi, s.ns)), std::min(diffuse_.tanHalf, dot(wi, s.ng))});
  if (s.m.roughness >= kSharpRoughness) {
    const ConeShape shape = lobe(s, bsdf.pdfSpecular(wi));
    f.specular = bsdf.evaluateSpecular(wi) *
                 field_.glow.pointShare(
                     g.point, s.p, {shape.pdf, by == Reflection::Ray ? 0 : std::min(shape.tanHalf, dot(wi, s.ng))});
  }
  sum.add(f, g.light.radiance * visible(s, g.light, f, count));
}

// Of all diffuse cones of a shading together.
float ConeShader::conePdf(float cosSurface) const {
  return static_cast<float>(settings_.conesPerShading) * std::max(0.0f, cosSurface) / kPi;
}

// A cone of the glossy lobe. The lobe is sampled, so the cone need only be as wide as the gaps between the samples.
ConeShape ConeShader::lobe(const SurfacePoint& s, float pdf) const {
  return {std::min(0.5f * s.m.roughness * s.m.roughness, diffuse_.tanHalf), 0, pdf};
}

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
    Vec3 d = frame.toWorld({first.x * std::cos(turn) - first.y * std::sin(turn),
                            first.x * std::sin(turn) + first.y * std::cos(turn), first.z});
    if (dot(d, s.ng) < 0.02f) d = normalize(d + s.ng * (0.04f - dot(d, s.ng)));
    ConeShape shape = diffuse_;
    shape.pdf = conePdf(dot(d, s.ns));
    const ConeLight c = marchCone(field_, start, d, shape, sampler.next1());
    sum += luminance(c.radiance) > doubt ? seen({offsetOrigin(s.p, s.ng), d, 0, kInfinity}, {s.p, shape.pdf, -1, false},
                                                irradiance, sampler, count)
                                         : c.radiance;
    sum += settings_.ambientCdM2 * (1 - c.occlusion);
    occlusion += c.occlusion / static_cast<float>(n);
  }
  count.cones += static_cast<uint64_t>(n);
  return sum / static_cast<float>(n);
}

// What an exact ray sees by the light that voxels hold, without lights and sky: it tells whether a cone that found much
// more light than its surroundings get looked through a wall thinner than voxels. Where a slot does not stand for the
// place met (a bar that goes on through a wall has sun on one end of it), that is lit afresh, and what others reflect
// there is taken for that of the ray's start.
Vec3 ConeShader::seen(Ray ray, const Reflected& from, Vec3 startLux, Sampler& sampler, GatherCounters& count) const {
  Vec3 sum, left(1);
  for (int k = 0; k < kMostPanes && maxComponent(left) > 1e-3f; ++k) {
    const Hit hit = rays_.intersect(ray);
    ++count.rays;
    if (!hit.valid()) break;
    const SurfacePoint s = surfaceAt(rays_.scene(), hit, ray.direction);
    if (const int64_t slot = slotAtSurface(voxels_, s.p, s.ng);
        slot >= 0 && isParted(static_cast<size_t>(slot), s, count)) {
      const Bsdf bsdf(s.m, s.ns, s.ng, -ray.direction);
      const LitSurface at{s, bsdf, Reflection::Cone};
      float unused = 0;
      const Vec3 direct = soft(at, guideOf(s), sampler, count).diffuse + sharp(at, {}, sampler, count, unused).diffuse;
      sum += left * (direct + bsdf.diffuseAlbedo() * startLux / kPi) * s.m.alpha;
    } else {
      sum += left * bihemisphericalAlbedo(s.m) * reflectedIrradiance(s, ray.direction, from, sampler, count) *
             (s.m.alpha / kPi);
    }
    left *= passing(s.m, *s.material, std::abs(dot(s.ns, ray.direction)));
    ray.origin = offsetOrigin(s.p, -s.ng);
  }
  return sum;
}

// Whether another surface stands between a place and where its slot takes its light.
bool ConeShader::isParted(size_t slot, const SurfacePoint& s, GatherCounters& count) const {
  const Vec3 from = s.p + s.ng * (kLift * voxels_.voxelSizeM),
             to = voxels_.slots[slot].position + s.ng * (kLift * voxels_.voxelSizeM);
  ++count.rays;
  return luminance(rays_.transmittance({from, to - from, 0, 1})) < 0.25f;
}

Vec3 ConeShader::glossy(const SurfacePoint& s, Vec3, const BsdfSample& r, Sampler& sampler,
                        GatherCounters& count) const {
  ++count.cones;
  return marchCone(field_, coneStart(s), r.wi, lobe(s, r.pdf), sampler.next1()).radiance;
}

// At s, where a ray reflected at from.p arrives. What the points of LampGlow give is left to them.
Vec3 ConeShader::reflectedIrradiance(const SurfacePoint& s, Vec3 direction, const Reflected& from, Sampler& sampler,
                                     GatherCounters&) const {
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
