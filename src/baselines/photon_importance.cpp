#include "baselines/photon_importance.h"

#include "base/parallel.h"
#include "base/sampling.h"
#include "trace/bsdf.h"
#include "trace/surfaces.h"

namespace roomlight {
namespace {

constexpr float kBeside = 0.05f;  // importance of a cell beside one that was seen
constexpr size_t kPathsAtOnce = 256;
constexpr int kLongestPath = 64;
constexpr uint64_t kFirstKey = uint64_t{3} << 40;  // other random numbers than pixels and photons have

}  // namespace

struct PhotonImportance::Part {
  std::vector<Vec3> places;
  std::vector<SkyProbe> sky;
  std::vector<std::vector<SunProbe>> suns;
  uint64_t rays = 0;
};

PhotonImportance::PhotonImportance(const RayScene& rays, const Lights& lights, const ImportonStart& start, int count,
                                   uint64_t seed)
    : suns_(lights.sunCount()) {
  const auto paths = static_cast<size_t>(count);
  std::vector<Part> parts((paths + kPathsAtOnce - 1) / kPathsAtOnce);
  parallelFor(parts.size(), 1, [&](size_t k) {
    parts[k].suns.resize(lights.sunCount());
    for (size_t i = k * kPathsAtOnce; i < std::min(paths, (k + 1) * kPathsAtOnce); ++i) {
      const auto index = static_cast<uint32_t>(i);
      Sampler sampler(kFirstKey, index, seed);
      const Ray ray = start(index, sampler);
      follow(rays, lights, ray, sampler, parts[k]);
    }
  });
  for (const Part& part : parts) {
    mark(part.places);
    sky_.insert(sky_.end(), part.sky.begin(), part.sky.end());
    for (size_t i = 0; i < suns_.size(); ++i) suns_[i].insert(suns_[i].end(), part.suns[i].begin(), part.suns[i].end());
    rays_ += part.rays;
  }
}

void PhotonImportance::mark(const std::vector<Vec3>& places) {
  for (const Vec3 p : places) {
    const PhotonCell c = PhotonCell::of(p);
    cells_[c.key()] += 1;
    for (int k = 0; k < 27; ++k) {
      float& beside = cells_[c.around(k).key()];
      beside = std::max(beside, kBeside);
    }
  }
}

float PhotonImportance::at(Vec3 p) const {
  const auto found = cells_.find(PhotonCell::of(p).key());
  return found == cells_.end() ? 0 : found->second;
}

void PhotonImportance::follow(const RayScene& rays, const Lights& lights, Ray ray, Sampler& sampler, Part& out) const {
  for (int length = 0; length < kLongestPath; ++length) {
    const Hit hit = rays.intersect(ray);
    ++out.rays;
    if (!hit.valid()) return;
    const SurfacePoint s = rays.surfaces().at(hit, ray.direction);
    const Vec3 wo = -ray.direction;
    const Bsdf bsdf(s.m, s.ns, s.ng, wo);
    const float through = luminance(passing(s.m, *s.material, dot(s.ns, wo))),
                back = luminance(bsdf.albedo()) * s.m.alpha;
    if (sampler.next1() * (through + back) < through) {
      ray.origin = offsetOrigin(s.p, -s.ng);
      continue;
    }
    out.places.push_back(s.p);
    const Vec3 clear = offsetOrigin(s.p, s.ng);
    if (lights.sky().present()) {
      const Vec3 d = Frame(s.ng).toWorld(sampleCosineHemisphere(sampler.next2()));
      out.sky.push_back({s.p, s.ng, d, luminance(rays.transmittance({clear, d, 0, kInfinity}))});
      ++out.rays;
    }
    for (size_t i = 0; i < lights.sunCount(); ++i) {
      const LightSample sun = lights.sampleSun(i, sampler.next2());
      if (!(dot(sun.wi, s.ng) > 0)) continue;
      const float open = luminance(rays.transmittance({clear, sun.wi, 0, kInfinity}));
      ++out.rays;
      if (open > 0) out.suns[i].push_back({s.p, s.ng, sun.wi, open});
    }
    const Vec2 u = sampler.next2();
    const BsdfSample next = bsdf.sample(u, sampler.next1());
    if (!next.valid() || dot(next.wi, s.ng) <= 0 || sampler.next1() >= std::min(0.98f, maxComponent(next.weight)))
      return;
    ray = {clear, next.wi, 0, kInfinity};
  }
}

}  // namespace roomlight
