#include "reference/light_vertices.h"

#include "base/parallel.h"
#include "base/sampler.h"
#include "trace/surfaces.h"

namespace roomlight {
namespace {

constexpr size_t kPathsAtOnce = 256;
constexpr int kLongestPath = 4096;
// Keeps the random numbers of light paths apart from those of pixels.
constexpr uint64_t kFirstKey = uint64_t{1} << 40;

}  // namespace

Bsdf LightVertex::bsdf(Vec3 wo) const {
  MaterialSample m;
  m.baseColor = base;
  m.f0 = f0, m.f90 = f90;
  m.roughness = roughness;
  return Bsdf(m, bentNormal(ns, ng, -wo), ng, wo);
}

void LightVertices::trace(int paths, uint32_t pass, uint64_t seed) {
  const auto count = static_cast<size_t>(paths);
  struct Part {
    std::vector<LightVertex> vertices;
    uint64_t rays = 0;
  };
  std::vector<Part> parts((count + kPathsAtOnce - 1) / kPathsAtOnce);
  parallelFor(parts.size(), 1, [&](size_t k) {
    for (size_t i = k * kPathsAtOnce; i < std::min(count, (k + 1) * kPathsAtOnce); ++i) {
      follow(i, 1 / static_cast<float>(paths), pass, seed, parts[k].vertices, parts[k].rays);
    }
  });
  all_.clear();
  size_t total = 0;
  for (const Part& part : parts) total += part.vertices.size();
  all_.reserve(total);
  for (Part& part : parts) {
    all_.insert(all_.end(), part.vertices.begin(), part.vertices.end());
    part.vertices = {};
    rayCount_ += part.rays;
  }
  perPath_ = static_cast<double>(total) / static_cast<double>(count);
}

void LightVertices::follow(uint64_t path, float share, uint32_t pass, uint64_t seed, std::vector<LightVertex>& out,
                           uint64_t& rayCount) const {
  Sampler sampler(kFirstKey + path, pass, seed);
  const LightRay start = lightRays_.sample(sampler);
  Ray ray{start.origin, start.direction, 0, kInfinity};
  Vec3 flux = start.fluxLm * share;
  for (int length = 0; length < kLongestPath && !isBlack(flux); ++length) {
    const Hit hit = rays_.intersect(ray);
    ++rayCount;
    if (!hit.valid()) return;
    const SurfacePoint s = rays_.surfaces().at(hit, ray.direction);
    const Vec3 wi = -ray.direction;
    const Bsdf bsdf(s.m, s.ns, s.ng, wi);
    if (LightVertices::connects(bsdf)) {
      const Vec3 scattered = flux * s.m.alpha;
      out.push_back({s.p, s.ng, s.smooth, wi, luminance(scattered * bsdf.diffuseAlbedo()),
                     luminance(scattered * bsdf.specularAlbedo()), bsdf.alpha(), lightRays_.densityM2(s.p, s.ng),
                     scattered, s.m.baseColor * ((1 - s.m.metallic) * (1 - s.m.transmission)), s.m.f0, s.m.f90,
                     s.m.roughness, start.lamp, start.emitter});
    }
    // Thin glass and blended alpha, as for paths from the camera.
    if (s.m.alpha < 1 || s.m.transmission > 0) {
      const Vec3 through = straightTransmittance(*s.material, s.m, dot(s.ns, wi));
      const float t = luminance(through), r = luminance(bsdf.albedo()) * s.m.alpha;
      const float chance = t + r > 0 ? t / (t + r) : 1;
      if (sampler.next1() < chance) {
        flux *= through / chance;
        ray.origin = offsetOrigin(s.p, -s.ng);
        continue;
      }
      flux *= s.m.alpha / (1 - chance);
    }
    // Russian roulette by albedo, from the first vertex on.
    const float q = std::min(maxComponent(bsdf.albedo()), 0.98f);
    if (sampler.next1() >= q) return;
    flux *= 1 / q;
    const Vec2 u = sampler.next2();
    const BsdfSample next = bsdf.sample(u, sampler.next1());
    if (!next.valid() || dot(next.wi, s.ng) <= 0) return;
    if (next.mirror) {
      flux *= next.weight;
    } else {
      // What a path coming the other way would find here: flux spreads by the true surface, scattering sees the shading
      // normal.
      const Vec3 f = Bsdf(s.m, bentNormal(s.smooth, s.ng, -next.wi), s.ng, next.wi).evaluate(wi);
      flux *= f * (dot(s.ng, next.wi) / (std::max(dot(s.ng, wi), 1e-6f) * next.pdf));
    }
    ray = {offsetOrigin(s.p, s.ng), next.wi, 0, kInfinity};
  }
}

}  // namespace roomlight
