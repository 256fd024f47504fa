#include "baselines/photon.h"

#include <algorithm>
#include <array>

#include "base/sampling.h"

namespace roomlight {
namespace {

constexpr int kMostPanes = 16;
constexpr int kMostRays = 64;      // traced at once
constexpr int kMostGathers = 4;    // one after the other, where each is near the last
constexpr float kLeastChance = 0.1f;

}  // namespace

PhotonShader::PhotonShader(const RayScene& rays, const Lights& lights, const PhotonLight& light,
                           const PhotonSettings& settings)
    : DirectShader(rays, lights, light.survey.voxels, light.survey.guide, settings.rayRoughness),
      light_(light),
      settings_(settings),
      global_(rays, light.global, settings.nearest, settings),
      caustic_(rays, light.caustic, settings.causticNearest, settings) {}

// What other surfaces send: all but what comes straight from lights and sky.
Vec3 PhotonShader::indirect(const SurfacePoint& s, Sampler& sampler, GatherCounters& count, float&) const {
  const Vec3 caustics = causticsAt(s, count);
  if (settings_.finalGather > 0) return gathered(s, settings_.finalGather, 0, sampler, count) + caustics;
  return global_.at(s.p, s.ng, count.rays).lux / kPi + caustics;
}

// Rough lobes reflect little beside the diffuse one: what maps say of them is asked for in proportion.
Vec3 PhotonShader::glossy(const SurfacePoint& s, Vec3, const BsdfSample& r, Sampler& sampler,
                          GatherCounters& count) const {
  const float chance = std::clamp(luminance(r.weight), kLeastChance, 1.0f);
  const bool asked = sampler.next1() < chance;
  Vec3 sum = asked ? causticsAt(s, count) / chance : Vec3(0);
  if (settings_.finalGather == 0) return asked ? sum + global_.at(s.p, s.ng, count.rays).lux / (kPi * chance) : sum;
  const Ray ray{offsetOrigin(s.p, s.ng), r.wi, 0, kInfinity};
  ++count.rays;
  return sum + arriving(ray, rays_.intersect(ray), 0, sampler, count);
}

Vec3 PhotonShader::reflectedIrradiance(const SurfacePoint& s, Vec3 direction, const Reflected& from, Sampler& sampler,
                                       GatherCounters& count) const {
  if (settings_.finalGather == 0) return DirectShader::reflectedIrradiance(s, direction, from, sampler, count);
  return light_.irradiance.at(s.p, s.ng, rays_, global_, settings_, count.rays).lux;
}

// Irradiance / pi.
Vec3 PhotonShader::causticsAt(const SurfacePoint& s, GatherCounters& count) const {
  return light_.caustic.empty() ? Vec3(0) : caustic_.at(s.p, s.ng, count.rays).lux / kPi;
}

// Mean of what arrives over the cosine-weighted hemisphere.
Vec3 PhotonShader::gathered(const SurfacePoint& s, int rays, int depth, Sampler& sampler, GatherCounters& count) const {
  const Frame frame(s.ns);
  std::array<Ray, kMostRays> ray;
  std::array<Hit, kMostRays> hit;
  Vec3 sum;
  const Vec2 shift = sampler.next2();
  for (int first = 0; first < rays; first += kMostRays) {
    const int n = std::min(kMostRays, rays - first);
    size_t used = 0;
    for (int i = 0; i < n; ++i) {
      // A shifted lattice: strata within the shading; the sampler spreads the shadings of a pixel.
      const float x = shift.x + static_cast<float>(first + i) / static_cast<float>(rays),
                  y = shift.y + 0.61803399f * static_cast<float>(first + i);
      const Vec3 d = frame.toWorld(sampleCosineHemisphere({x - std::floor(x), y - std::floor(y)}));
      if (dot(d, s.ng) > 0) ray[used++] = {offsetOrigin(s.p, s.ng), d, 0, kInfinity};
    }
    rays_.intersect(std::span<const Ray>(ray).first(used), std::span(hit).first(used));
    count.rays += used;
    for (size_t i = 0; i < used; ++i) sum += arriving(ray[i], hit[i], depth, sampler, count);
  }
  return sum / static_cast<float>(rays);
}

// What surfaces along a ray send back by their diffuse and rough lobes, through panes and smooth surfaces too. Lights
// and sky are not in it: those seen straight are sampled where the ray started, those seen in smooth surfaces are
// caustics.
Vec3 PhotonShader::arriving(Ray ray, Hit hit, int depth, Sampler& sampler, GatherCounters& count) const {
  Vec3 sum, left(1);
  float distance = 0;
  for (int k = 0; k < kMostPanes; ++k) {
    if (k > 0) hit = rays_.intersect(ray), ++count.rays;
    if (!hit.valid()) break;
    const SurfacePoint s = surfaceAt(rays_.scene(), hit, ray.direction);
    distance += hit.t;
    const Bsdf bsdf(s.m, s.ns, s.ng, -ray.direction);
    const bool smooth = s.m.roughness < settings_.rayRoughness;
    const Vec3 rho = smooth ? bsdf.diffuseAlbedo() : bihemisphericalAlbedo(s.m);
    if (maxComponent(rho) > 1e-4f)
      sum += left * rho * lit(s, ray.direction, distance, depth, sampler, count) * (s.m.alpha / kPi);
    const Vec3 through = passing(s.m, *s.material, std::abs(dot(s.ns, ray.direction))),
               mirrored = smooth ? bsdf.specularAlbedo() * s.m.alpha : Vec3(0);
    const float pThrough = luminance(left * through), pMirrored = luminance(left * mirrored),
                survive = std::min(1.0f, 2 * (pThrough + pMirrored));
    if (!(survive > 0)) break;
    const float u = sampler.next1(), split = survive * pThrough / (pThrough + pMirrored);
    if (u >= survive) break;
    if (u < split) {
      left *= through / split;
      ray.origin = offsetOrigin(s.p, -s.ng);
      continue;
    }
    const BsdfSample r = bsdf.sampleSpecular(sampler.next2());
    if (!r.valid()) break;
    left *= r.weight * (s.m.alpha / (survive - split));
    ray = {offsetOrigin(s.p, s.ng), r.wi, 0, kInfinity};
  }
  return sum;
}

// Illuminance, lx, where a gathering ray arrives after so many metres. Next to where it started the map is too coarse:
// there light is worked out once more.
Vec3 PhotonShader::lit(const SurfacePoint& s, Vec3 direction, float distanceM, int depth, Sampler& sampler,
                       GatherCounters& count) const {
  const PhotonIrradiance known = light_.irradiance.at(s.p, s.ng, rays_, global_, settings_, count.rays);
  if (depth >= kMostGathers || distanceM >= settings_.nearRadii * known.radiusM) return known.lux;
  SurfacePoint white = s;
  white.m = {};
  white.m.baseColor = Vec3(1);
  const Bsdf bsdf(white.m, s.ns, s.ng, -direction);
  const LitSurface at{white, bsdf, Reflection::Cone};
  float unused = 0;
  const Vec3 direct = soft(at, guideOf(s), sampler, count).diffuse + sharp(at, {}, sampler, count, unused).diffuse;
  return (direct + gathered(s, 1, depth + 1, sampler, count) + causticsAt(s, count)) * kPi;
}

}  // namespace roomlight
