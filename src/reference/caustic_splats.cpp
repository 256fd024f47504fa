#include "reference/caustic_splats.h"

#include <algorithm>
#include <atomic>
#include <span>

#include "base/parallel.h"
#include "base/sampler.h"
#include "trace/bsdf.h"
#include "trace/surfaces.h"

namespace roomlight {
namespace {

constexpr size_t kMostSeen = 1 << 14;  // places
constexpr int kMostPanes = 16;         // before one
constexpr size_t kPixelsPerPhoton = 4, kFewestPhotons = 1 << 10, kMostPhotons = 1 << 18;  // of a round
constexpr size_t kAtOnce = 512;                                                           // photons
constexpr uint64_t kSeenKey = uint64_t{1} << 41, kPhotonSeed = 0xca057;  // other random numbers than paths have

}  // namespace

// Between a photon and its pixel.
struct CausticSplats::Connection {
  Splat splat;
  Ray way;
};

CausticSplats::CausticSplats(const TracedScene& scene, const View& view, uint64_t seed)
    : scene_(std::make_unique<TracedScene>(scene)), view_(std::make_unique<View>(view)) {
  const Scene& s = scene.rays.scene();
  const bool throws = std::any_of(s.instances.begin(), s.instances.end(), [&](const Instance& i) {
    return throwsLight(s.materials[static_cast<size_t>(s.meshes[static_cast<size_t>(i.mesh)].material)]);
  });
  // The same where light is told apart: layers change no picture.
  if (throws && view.camera.hasExactPixels())
    photons_ = std::make_unique<CausticPhotons>(scene, seenPlaces(seed), CausticPhotons::Wish{false, view.white},
                                                seed ^ kPhotonSeed);
}

// Of some pixels, straight or through panes.
std::vector<Vec3> CausticSplats::seenPlaces(uint64_t seed) {
  const size_t pixels = static_cast<size_t>(view_->width) * static_cast<size_t>(view_->height),
               count = std::min(pixels, kMostSeen);
  std::vector<Vec3> out;
  for (size_t i = 0; i < count; ++i) {
    const size_t pixel = i * pixels / count;
    Sampler sampler(kSeenKey + pixel, 0, seed);
    const Vec2 jitter = sampler.next2();
    const float x = static_cast<float>(pixel % static_cast<size_t>(view_->width)) + jitter.x,
                y = static_cast<float>(pixel / static_cast<size_t>(view_->width)) + jitter.y;
    Ray ray = view_->camera.seeing(scene_->rays, x, y);
    if (ray.tMax <= 0) continue;
    for (int pane = 0; pane < kMostPanes; ++pane) {
      const Hit hit = scene_->rays.intersect(ray);
      ++rayCount_;
      if (!hit.valid()) break;
      const SurfacePoint s = scene_->rays.surfaces().at(hit, ray.direction);
      if (!throwsLight(*s.material)) out.push_back(s.p);
      if (isBlack(passing(s.m, *s.material, std::abs(dot(s.ns, ray.direction))))) break;
      ray.origin = offsetOrigin(s.p, -s.ng), ray.tMin = 0;
    }
  }
  return out;
}

// Flux Φ that arrives at p from wi gives the mean of a pixel f(wi, wo) Φ cos θ / A: A is the area that a pixel covers
// at p, seen straight.
bool CausticSplats::connect(const CausticPhoton& photon, Connection& out) const {
  const std::optional<Vec2> at = view_->camera.pixelOf(photon.p);
  if (!at) return false;
  const Ray ray = view_->camera.seeing(scene_->rays, at->x, at->y);
  const float cosine = -dot(photon.n, ray.direction), t = dot(photon.p - ray.origin, ray.direction);
  if (cosine <= 0 || t <= ray.tMin || t >= ray.tMax) return false;
  SurfacePoint s = scene_->rays.surfaces().at(photon.hit, ray.direction);
  if (view_->white) s.m = whitened(s.m);
  const float arrives = dot(s.ng, photon.wi);
  if (arrives <= 0) return false;
  const int x = std::min(static_cast<int>(at->x), view_->width - 1),
            y = std::min(static_cast<int>(at->y), view_->height - 1);
  const float pixelM = view_->camera.pixelWidthM(x, y, photon.p);
  const Vec3 f = Bsdf(s.m, s.ns, s.ng, -ray.direction).evaluateDiffuse(photon.wi) * (s.m.alpha / arrives);
  out.splat.pixel = static_cast<uint32_t>(y) * static_cast<uint32_t>(view_->width) + static_cast<uint32_t>(x);
  out.splat.light = f * photon.fluxLm * (cosine / (pixelM * pixelM));
  out.splat.layer = view_->layers ? layerOf(photon, *view_->layers) : -1;
  const Vec3 from = offsetOrigin(photon.p, photon.n);
  out.way = {from, ray.origin + ray.direction * ray.tMin - from, 0, 1};
  return !isBlack(out.splat.light);
}

std::vector<CausticSplats::Splat> CausticSplats::trace(uint32_t round) {
  if (!any()) return {};
  const size_t pixels = static_cast<size_t>(view_->width) * static_cast<size_t>(view_->height);
  const std::vector<CausticPhoton> photons =
      photons_->trace(std::clamp(pixels / kPixelsPerPhoton, kFewestPhotons, kMostPhotons), round);
  std::vector<std::vector<Splat>> parts((photons.size() + kAtOnce - 1) / kAtOnce);
  std::atomic<uint64_t> rayCount = 0;
  parallelFor(parts.size(), 1, [&](size_t k) {
    std::vector<Connection> some;
    std::vector<Ray> ways;
    for (size_t i = k * kAtOnce; i < std::min(photons.size(), (k + 1) * kAtOnce); ++i) {
      if (Connection c; connect(photons[i], c)) some.push_back(c), ways.push_back(c.way);
    }
    std::vector<Vec3> left(ways.size());
    scene_->rays.transmittance(ways, left);
    rayCount += ways.size();
    for (size_t i = 0; i < some.size(); ++i) {
      some[i].splat.light *= left[i];
      if (!isBlack(some[i].splat.light)) parts[k].push_back(some[i].splat);
    }
  });
  rayCount_ += rayCount;
  std::vector<Splat> out;
  for (const std::vector<Splat>& part : parts) out.insert(out.end(), part.begin(), part.end());
  return out;
}

}  // namespace roomlight
