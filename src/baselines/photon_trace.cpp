#include "baselines/photon_trace.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "base/sampling.h"
#include "trace/bsdf.h"
#include "trace/surfaces.h"

namespace roomlight {
namespace {

constexpr size_t kPathsAtOnce = 1024, kPartsAtOnce = 64;
constexpr size_t kPilots = 1024, kFewPilots = 128, kManySources = 64;
constexpr float kFloorShare = 0.05f;  // of all photons, for sources whose pilots found nothing
constexpr int kLongestPath = 4096;    // no physics but a loop between perfect mirrors
constexpr float kLeastAlbedo = 1e-4f;
constexpr uint64_t kFirstKey = uint64_t{5} << 40;  // other random numbers than pixels and importons have

}  // namespace

// Which photons are asked for.
struct PhotonTracer::Wish {
  bool direct, caustic, indirect;
  int count;
  uint64_t key;
  bool keeps(PhotonKind kind) const {
    return kind == PhotonKind::Direct ? direct : kind == PhotonKind::Caustic ? caustic : indirect;
  }
};

struct PhotonTracer::Source {
  double score = 0;    // flux of what is kept times its importance, of one photon sent out on average
  double keptEach = 0; // photons kept for one that is sent out
  uint64_t count = 0;  // to be sent out
};

PhotonTracer::PhotonTracer(const RayScene& rays, const Lights& lights, const PhotonImportance& importance,
                           const SkySurvey& survey, const PhotonSettings& settings)
    : rays_(rays), importance_(importance), settings_(settings), sources_(rays, lights, importance, survey) {}

TracedPhotons PhotonTracer::global(bool indirectOnly, const Progress& progress) const {
  return trace({!indirectOnly, !indirectOnly, true, settings_.photons, kFirstKey}, progress);
}

TracedPhotons PhotonTracer::caustics(const Progress& progress) const {
  return trace({false, true, false, settings_.causticPhotons, 2 * kFirstKey}, progress);
}

// Returns the number of rays traced. keep(photon, importance) is called where one is of use.
template <class Keep>
uint64_t PhotonTracer::follow(const PhotonStart& start, float share, const Wish& wish, Sampler& sampler,
                              Keep&& keep) const {
  Ray ray{start.ray.origin, start.ray.direction, 0, kInfinity};
  Vec3 flux = start.ray.fluxLm * share;
  bool specular = false, diffuse = false;
  int reflections = 0;
  uint64_t rayCount = 0;
  for (int length = 0; length < kLongestPath && !isBlack(flux); ++length) {
    const Hit hit = rays_.intersect(ray);
    ++rayCount;
    if (!hit.valid()) break;
    const SurfacePoint s = rays_.surfaces().at(hit, ray.direction);
    const Vec3 wi = -ray.direction;
    const Bsdf bsdf(s.m, s.ns, s.ng, wi);
    const bool smooth = s.m.roughness < settings_.rayRoughness;
    const PhotonKind kind = diffuse ? PhotonKind::Indirect : specular ? PhotonKind::Caustic : PhotonKind::Direct;
    if (wish.keeps(kind) && maxComponent(smooth ? bsdf.diffuseAlbedo() : bsdf.albedo()) * s.m.alpha > kLeastAlbedo) {
      if (const float importance = importance_.at(s.p); importance > 0) keep(Photon{s.p, flux, wi, s.ng}, importance);
    }
    // Thin glass and blended alpha, as for paths from the camera.
    const float through = luminance(passing(s.m, *s.material, dot(s.ns, wi))),
                back = luminance(bsdf.albedo()) * s.m.alpha;
    if (!(through + back > 0)) break;
    const float chance = through / (through + back);
    if (chance > 0 && sampler.next1() < chance) {
      if (start.arrives && length == 0) break;
      flux *= passing(s.m, *s.material, dot(s.ns, wi)) / chance;
      ray.origin = offsetOrigin(s.p, -s.ng);
      continue;
    }
    flux *= s.m.alpha / (1 - chance);
    const float lobe = luminance(bsdf.specularAlbedo()) / std::max(luminance(bsdf.albedo()), 1e-20f);
    const bool glossy = sampler.next1() < lobe;
    BsdfSample next;
    const Vec2 u = sampler.next2();
    if (glossy) {
      next = bsdf.sampleSpecular(u);
      if (!next.valid()) break;
      next.weight = next.weight / lobe;
    } else {
      next.wi = Frame(s.ns).toWorld(sampleCosineHemisphere(u));
      next.weight = bsdf.evaluateDiffuse(next.wi) * (kPi / (std::max(dot(next.wi, s.ns), 1e-6f) * (1 - lobe)));
    }
    if (dot(next.wi, s.ng) <= 0) break;
    specular = specular || (glossy && smooth);
    diffuse = diffuse || !(glossy && smooth);
    if (diffuse && !wish.direct && !wish.indirect) break;
    const Vec3 before = flux;
    flux *= next.weight;
    if (!next.mirror) flux *= shadingCorrection(s, wi, next.wi);
    if (++reflections >= settings_.rouletteDepth) {
      const float q = std::min(maxComponent(flux) / std::max(maxComponent(before), 1e-30f), 1.0f);
      if (sampler.next1() >= q) break;
      flux = flux / q;
    }
    ray = {offsetOrigin(s.p, s.ng), next.wi, 0, kInfinity};
  }
  return rayCount;
}

// A few pilots of every source tell what it is good for; photons go where flux times importance is, so that all kept
// are worth about the same.
std::vector<PhotonTracer::Source> PhotonTracer::plan(const Wish& wish, uint64_t& rayCount) const {
  std::vector<Source> sources(sources_.count());
  const size_t pilots = sources.size() > kManySources ? kFewPilots : kPilots;
  std::vector<uint64_t> rays(sources.size());
  parallelFor(sources.size(), 1, [&](size_t i) {
    Source& source = sources[i];
    for (size_t k = 0; k < pilots; ++k) {
      Sampler sampler(wish.key + i + (uint64_t{1} << 32), static_cast<uint32_t>(k), settings_.seed);
      const PhotonStart start = sources_.sample(i, sampler, rays[i]);
      rays[i] +=
          follow(start, 1 / static_cast<float>(pilots), wish, sampler, [&](const Photon& photon, float importance) {
            source.score += static_cast<double>(luminance(photon.fluxLm) * importance);
            source.keptEach += 1 / static_cast<double>(pilots);
          });
    }
  });
  for (const uint64_t n : rays) rayCount += n;
  double sum = 0;
  for (const Source& s : sources) sum += s.score;
  const double n = static_cast<double>(sources.size());
  double kept = 0;
  for (Source& s : sources) {
    s.score =
        sum > 0 ? (1 - static_cast<double>(kFloorShare)) * s.score / sum + static_cast<double>(kFloorShare) / n : 1 / n;
    kept += s.score * s.keptEach;
  }
  // Where pilots found nothing there may be nothing.
  const double most = (kept > 0 ? static_cast<double>(settings_.mostEmitted) : 1.0) * wish.count,
               emitted = std::min(most, wish.count / std::max(kept, 1e-9));
  for (Source& s : sources) s.count = static_cast<uint64_t>(std::ceil(emitted * s.score));
  return sources;
}

TracedPhotons PhotonTracer::trace(const Wish& wish, const Progress& progress) const {
  TracedPhotons out;
  if (wish.count == 0) return out;
  struct Part {
    size_t source;
    uint64_t first, end;
    float share;
    std::vector<Photon> photons;
    uint64_t rays = 0;
  };
  const std::vector<Source> sources = plan(wish, out.rays);
  std::vector<Part> parts;
  for (size_t i = 0; i < sources.size(); ++i) {
    const uint64_t n = sources[i].count;
    for (uint64_t first = 0; first < n; first += kPathsAtOnce)
      parts.push_back({i, first, std::min<uint64_t>(n, first + kPathsAtOnce), 1 / static_cast<float>(n), {}});
    out.emitted += n;
  }
  for (size_t done = 0; done < parts.size(); done += kPartsAtOnce) {
    if (progress.stop()) return {};
    parallelFor(std::min(kPartsAtOnce, parts.size() - done), 1, [&](size_t k) {
      Part& part = parts[done + k];
      for (uint64_t path = part.first; path < part.end; ++path) {
        Sampler sampler(wish.key + part.source, static_cast<uint32_t>(path), settings_.seed);
        const PhotonStart start = sources_.sample(part.source, sampler, part.rays);
        part.rays += follow(start, part.share, wish, sampler,
                            [&](const Photon& photon, float) { part.photons.push_back(photon); });
      }
    });
    progress.at(static_cast<float>(done) / static_cast<float>(parts.size()));
  }
  size_t total = 0;
  for (const Part& part : parts) total += part.photons.size();
  out.photons.reserve(total);
  for (Part& part : parts) {
    out.photons.insert(out.photons.end(), part.photons.begin(), part.photons.end());
    part.photons = {};
    out.rays += part.rays;
  }
  return out;
}

}  // namespace roomlight
