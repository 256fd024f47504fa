#include "baselines/photon_estimate.h"

#include <array>
#include <cmath>

#include "base/parallel.h"
#include "base/random.h"

namespace roomlight {
namespace {

constexpr size_t kMostEdgeRays = 64;
constexpr size_t kProbesPerRay = 2;
constexpr float kLiftOfRadius = 0.1f, kLargestLiftM = 0.02f;
constexpr float kConeReach = 1.1f;   // of the radius: where the cone kernel ends
constexpr float kGoldenAngleRad = 2.39996323f;

float kernelAt(PhotonKernel kernel, float t2) {
  switch (kernel) {
    case PhotonKernel::Cone: return 1 - std::sqrt(t2) / kConeReach;
    case PhotonKernel::Epanechnikov: return 1 - t2;
    case PhotonKernel::Disc: break;
  }
  return 1;
}

// Mean over the disc.
float kernelMean(PhotonKernel kernel) {
  switch (kernel) {
    case PhotonKernel::Cone: return 1 - 2 / (3 * kConeReach);
    case PhotonKernel::Epanechnikov: return 0.5f;
    case PhotonKernel::Disc: break;
  }
  return 1;
}

// Where rays along the surface start.
Vec3 lifted(Vec3 p, Vec3 n, float radiusM) {
  return offsetOrigin(p, n) + n * std::min(kLiftOfRadius * radiusM, kLargestLiftM);
}

// Which part of the disc of radius r around p is the surface that p lies on. Rays along the surface find the walls that
// end it: what lies behind the line between the ends of two of them is not seen. Rays down to it find where it just
// stops.
class SurfaceDisc {
 public:
  SurfaceDisc(const RayScene& rays, Vec3 p, Vec3 n, float radiusM, const PhotonSettings& settings, uint64_t& rayCount)
      : frame_(n), count_(std::min(static_cast<size_t>(settings.edgeRays), kMostEdgeRays)) {
    lifted_ = lifted(p, n, radiusM);
    const float reach = radiusM / std::cos(kPi / static_cast<float>(count_)) * 1.001f;
    std::array<Ray, kMostEdgeRays> out;
    std::array<Hit, kMostEdgeRays> hits;
    for (size_t i = 0; i < count_; ++i) {
      const float angle = 2 * kPi * static_cast<float>(i) / static_cast<float>(count_);
      out[i] = {lifted_, frame_.t * std::cos(angle) + frame_.b * std::sin(angle), 0, reach};
    }
    rays.intersect(std::span(out).first(count_), std::span(hits).first(count_));
    rayCount += count_;
    for (size_t i = 0; i < count_; ++i) {
      const float angle = 2 * kPi * static_cast<float>(i) / static_cast<float>(count_),
                  d = hits[i].valid() ? hits[i].t : reach;
      walls_ = walls_ || hits[i].valid();
      corner_[i] = {d * std::cos(angle), d * std::sin(angle)};
    }
  }
  bool sees(Vec3 offset) const {
    if (!walls_) return true;
    const Vec2 o{dot(offset, frame_.t), dot(offset, frame_.b)};
    const float turn = std::atan2(o.y, o.x) / (2 * kPi), at = (turn < 0 ? turn + 1 : turn) * static_cast<float>(count_);
    const size_t i = std::min(static_cast<size_t>(at), count_ - 1);
    const Vec2 a = corner_[i], side = corner_[(i + 1) % count_] - a, to = o - a;
    return side.x * to.y - side.y * to.x >= 0;
  }
  // Kernel over what is surface, as a share of that over the whole disc.
  float share(const RayScene& rays, Vec3 p, float radiusM, const PhotonSettings& settings, uint64_t& rayCount) const {
    const size_t probes = kProbesPerRay * count_;
    const float thick = radiusM / settings.flatness;
    std::array<Ray, kProbesPerRay * kMostEdgeRays> down;
    std::array<Hit, kProbesPerRay * kMostEdgeRays> hits;
    std::array<float, kProbesPerRay * kMostEdgeRays> weight;
    const uint32_t turned =
        mix32(static_cast<uint32_t>(mix64(static_cast<uint64_t>(std::bit_cast<uint32_t>(p.x)) * 3 +
                                          std::bit_cast<uint32_t>(p.y) * 5ull + std::bit_cast<uint32_t>(p.z) * 7ull)));
    const float first = static_cast<float>(turned >> 8) * 0x1p-24f * 2 * kPi;
    size_t used = 0;
    float all = 0, found = 0;
    for (size_t i = 0; i < probes; ++i) {
      const float t2 = (static_cast<float>(i) + 0.5f) / static_cast<float>(probes),
                  angle = first + kGoldenAngleRad * static_cast<float>(i);
      const Vec3 offset = (frame_.t * std::cos(angle) + frame_.b * std::sin(angle)) * (std::sqrt(t2) * radiusM);
      const float w = kernelAt(settings.kernel, t2);
      all += w;
      if (!sees(offset)) continue;
      weight[used] = w;
      down[used++] = {p + offset + frame_.n * thick, -frame_.n, 0, 2 * thick};
    }
    rays.intersect(std::span(down).first(used), std::span(hits).first(used));
    rayCount += used;
    for (size_t i = 0; i < used; ++i) found += isSurface(hits[i]) ? weight[i] : 0;
    // Some of it there must be where photons are.
    return std::max(found, 0.5f) / all;
  }
  bool walls() const { return walls_; }

 private:
  bool isSurface(const Hit& hit) const {
    return hit.valid() && std::abs(dot(hit.ng, frame_.n)) > 0.7f * length(hit.ng);
  }
  Frame frame_;
  size_t count_;
  Vec3 lifted_;
  bool walls_ = false;
  std::array<Vec2, kMostEdgeRays> corner_;
};

}  // namespace

PhotonIrradiance PhotonEstimate::at(Vec3 p, Vec3 n, uint64_t& rayCount, int64_t self) const {
  thread_local std::vector<NearPhoton> near;
  PhotonQuery query{p, n, settings_.flatness, 0.7f, settings_.largestRadiusM};
  // What came from below the surface at p is light on another one.
  const auto lights = [&](uint32_t i) { return i != self && dot(map_.direction(i), n) > 0; };
  map_.nearest(query, nearest_, near, [&](uint32_t i, Vec3) { return lights(i); });
  if (near.empty()) return {{}, settings_.largestRadiusM};
  const auto farthest = [&] {
    return std::max_element(near.begin(), near.end(),
                            [](NearPhoton a, NearPhoton b) { return a.distance2 < b.distance2; });
  };
  const bool full = near.size() == nearest_ && nearest_ > 1;
  float radius2 = full ? farthest()->distance2 : settings_.largestRadiusM * settings_.largestRadiusM;
  if (!(radius2 > 0)) return {};
  const float radiusM = std::sqrt(radius2);
  float share = 1;
  bool walls = false;
  if (settings_.edgeRays > 0) {
    const SurfaceDisc disc(rays_, p, n, radiusM, settings_, rayCount);
    share = disc.share(rays_, p, radiusM, settings_, rayCount);
    walls = disc.walls();
    if (walls) std::erase_if(near, [&](NearPhoton photon) { return !disc.sees(map_.place(photon.index) - p); });
  }
  // The farthest only tells how far the others may lie: with it the mean would be too large by 1 / k.
  Vec3 flux;
  for (const NearPhoton photon : near) {
    if (!full || photon.distance2 < radius2)
      flux += map_.fluxLm(photon.index) * kernelAt(settings_.kernel, photon.distance2 / radius2);
  }
  return {flux / (kPi * radius2 * kernelMean(settings_.kernel) * share), radiusM, walls};
}

IrradianceCache::IrradianceCache(const PhotonMap& map, const PhotonEstimate& estimate, const PhotonSettings& settings,
                                 uint64_t& rayCount, const Progress& progress) {
  constexpr size_t kAtOnce = 64, kBatch = 16384;
  const auto every = static_cast<size_t>(settings.irradianceEvery);
  const size_t count = (map.size() + every - 1) / every;
  std::vector<Photon> places(count);
  std::vector<Reach> reach(count);
  std::vector<uint64_t> rays((count + kAtOnce - 1) / kAtOnce);
  for (size_t first = 0; first < rays.size(); first += kBatch / kAtOnce) {
    if (progress.stop()) return;
    parallelFor(std::min(kBatch / kAtOnce, rays.size() - first), 1, [&](size_t k) {
      const size_t part = first + k;
      for (size_t i = part * kAtOnce; i < std::min(count, (part + 1) * kAtOnce); ++i) {
        const size_t photon = i * every;
        const Vec3 n = map.normal(photon);
        const PhotonIrradiance e = estimate.at(map.place(photon), n, rays[part], static_cast<int64_t>(photon));
        places[i] = {map.place(photon), e.lux, n, n};
        reach[i] = {e.radiusM, e.walls};
      }
    });
    progress.at(static_cast<float>(first) / static_cast<float>(rays.size()));
  }
  for (const uint64_t n : rays) rayCount += n;
  std::vector<uint32_t> order;
  places_ = PhotonMap(places, &order);
  for (const uint32_t i : order) reach_.push_back(reach[i]);
}

PhotonIrradiance IrradianceCache::at(Vec3 p, Vec3 n, const RayScene& rays, const PhotonEstimate& estimate,
                                     const PhotonSettings& settings, uint64_t& rayCount) const {
  thread_local std::vector<NearPhoton> near;
  places_.nearest({p, n, settings.flatness, 0.7f, settings.largestRadiusM}, 1, near);
  if (near.empty()) return estimate.at(p, n, rayCount);
  const size_t i = near[0].index;
  const Reach reach = reach_[i];
  if (near[0].distance2 > reach.radiusM * reach.radiusM) return estimate.at(p, n, rayCount);
  if (reach.walls) {
    const Vec3 from = lifted(p, n, reach.radiusM), to = lifted(places_.place(i), n, reach.radiusM);
    ++rayCount;
    if (isBlack(rays.transmittance({from, to - from, 0, 1}))) return estimate.at(p, n, rayCount);
  }
  return {places_.fluxLm(i), reach.radiusM, reach.walls};
}

}  // namespace roomlight
