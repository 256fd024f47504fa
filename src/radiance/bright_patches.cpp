#include "radiance/bright_patches.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>

#include "base/parallel.h"
#include "base/sampling.h"

namespace roomlight {
namespace {

constexpr size_t kMostPatches = 1024;   // of what the sun lights; the brightest
constexpr float kByFlux = 0.1f;         // of samples, among all patches: keeps each possible
constexpr size_t kRays = 512;           // that a patch sends out
constexpr float kBeside = 0.1f;         // of what lights a brick's neighbours
constexpr int kMostPanes = 6;
constexpr float kTries = 16;            // samples that a choice among candidates is worth
constexpr float kNudge = 0.05f;         // voxels

// Of a way with density a, beside one with density b.
float powerHeuristic(float a, float b) {
  if (!(a > 0)) return 0;
  const float ratio = b / a;
  return 1 / (1 + ratio * ratio);
}

struct PatchKey {
  int x, y, z, face;
  auto tied() const { return std::tie(z, y, x, face); }
  bool operator<(const PatchKey& o) const { return tied() < o.tied(); }
};

PatchKey keyAt(const Voxels& voxels, Vec3 p, Vec3 n, int face) {
  const Int3 v = voxels.voxelOf(p - n * (kNudge * voxels.voxelSizeM));
  const auto brick = [](int i) { return (i >= 0 ? i : i - kBrickSize + 1) / kBrickSize; };
  return {brick(v.x), brick(v.y), brick(v.z), face};
}

// All points of a slot belong to one patch.
PatchKey keyOf(const Voxels& voxels, int64_t slot) {
  const FaceSlot& s = voxels.slots[static_cast<size_t>(slot)];
  return keyAt(voxels, s.position, s.normal, s.face);
}

PatchKey keyOf(const Voxels& voxels, const GlowPoint& g) {
  return g.slot >= 0 ? keyOf(voxels, g.slot) : keyAt(voxels, g.p, g.n, dominantFace(g.n));
}

}  // namespace

BrightPatches::BrightPatches(const RayScene& rays, const Voxels& voxels, std::span<const GlowPoint> points,
                             std::span<const float> glowShare, float farM, uint64_t seed)
    : voxels_(&voxels), farM_(farM) {
  gatherPatches(voxels, points, glowShare);
  if (points_.empty()) return;
  learn(rays, seed);
}

void BrightPatches::gatherPatches(const Voxels& voxels, std::span<const GlowPoint> points,
                                  std::span<const float> glowShare) {
  std::map<PatchKey, std::vector<uint32_t>> byKey;
  for (uint32_t i = 0; i < points.size(); ++i) byKey[keyOf(voxels, points[i])].push_back(i);
  struct Found {
    PatchKey key;
    std::vector<uint32_t> points;
    float fluxLm = 0;
    bool lamps = false;
  };
  std::vector<Found> found;
  for (auto& [key, of] : byKey) {
    Found f{key, {}};
    for (const uint32_t i : of) f.fluxLm += luminance(points[i].fluxLm), f.lamps = f.lamps || !isSun(points[i]);
    f.points = std::move(of);
    if (f.fluxLm > 0) found.push_back(std::move(f));
  }
  // What paths leave to points must stay; of what the sun lights the brightest.
  std::stable_sort(found.begin(), found.end(),
                   [](const Found& a, const Found& b) { return a.lamps != b.lamps ? a.lamps : a.fluxLm > b.fluxLm; });
  const auto lamps =
      static_cast<size_t>(std::count_if(found.begin(), found.end(), [](const Found& f) { return f.lamps; }));
  found.resize(std::min(found.size(), lamps + kMostPatches));
  patchOfSlot_.assign(voxels.slots.size(), -1), holdsSun_.assign(voxels.slots.size(), 0);
  std::map<PatchKey, int32_t> patchOf;
  for (const Found& f : found) {
    Patch patch{static_cast<uint32_t>(points_.size()), static_cast<uint32_t>(f.points.size()), f.fluxLm};
    for (const uint32_t i : f.points) {
      const GlowPoint& g = points[i];
      points_.push_back({g});
      patchOfPoint_.push_back(static_cast<uint32_t>(patches_.size()));
      if (g.slot < 0) continue;
      patchOfSlot_[static_cast<size_t>(g.slot)] = static_cast<int32_t>(patches_.size());
      if (isSun(g)) holdsSun_[static_cast<size_t>(g.slot)] = 1;
    }
    patchOf[f.key] = static_cast<int32_t>(patches_.size());
    patches_.push_back(patch);
    upTo_.push_back(fluxLm_ += f.fluxLm);
  }
  for (float& v : upTo_) v /= fluxLm_;
  for (size_t s = 0; s < glowShare.size(); ++s) {
    if (!(glowShare[s] > 0) || patchOfSlot_[s] >= 0) continue;
    const auto of = patchOf.find(keyOf(voxels, static_cast<int64_t>(s)));
    if (of != patchOf.end()) patchOfSlot_[s] = of->second;
  }
}

// Where rays arrive that a patch sends out, through panes: bricks with how many, in their order.
std::vector<std::pair<uint32_t, uint32_t>> BrightPatches::lights(const RayScene& rays, uint32_t patch,
                                                                 uint64_t seed) const {
  const Patch& from = patches_[patch];
  const Scene& scene = rays.scene();
  std::vector<Ray> way;
  std::vector<Hit> hits;
  Sampler sampler(mix64(seed + 13), patch, 0);
  for (size_t i = 0; i < kRays; ++i) {
    const GlowPoint& g =
        points_[from.first +
                std::min(from.count - 1, static_cast<uint32_t>(sampler.fast1() * static_cast<float>(from.count)))];
    way.push_back({g.p, Frame(g.n).toWorld(sampleCosineHemisphere({sampler.fast1(), sampler.fast1()})), 0, kInfinity});
  }
  std::vector<uint32_t> bricks;
  for (int pane = 0; pane < kMostPanes && !way.empty(); ++pane) {
    hits.resize(way.size());
    rays.intersect(way, hits);
    size_t on = 0;
    for (size_t i = 0; i < way.size(); ++i) {
      if (!hits[i].valid()) continue;
      const Vec3 d = way[i].direction, p = way[i].origin + d * hits[i].t, g = normalize(hits[i].ng),
                 n = dot(g, d) < 0 ? g : -g;
      if (const int32_t b = brickSideAt(*voxels_, p, n); b >= 0) bricks.push_back(static_cast<uint32_t>(b));
      if (letsLightThrough(scene.materials[static_cast<size_t>(
              scene.meshes[static_cast<size_t>(scene.instances[hits[i].instance].mesh)].material)]))
        way[on++] = {offsetOrigin(p, -n), d, 0, kInfinity};
    }
    way.resize(on);
  }
  std::sort(bricks.begin(), bricks.end());
  std::vector<std::pair<uint32_t, uint32_t>> out;
  for (const uint32_t b : bricks) {
    if (out.empty() || out.back().first != b) out.emplace_back(b, 0);
    ++out.back().second;
  }
  return out;
}

// Which patches light each brick most, by the rays that they send; what lights its neighbours counts a little.
void BrightPatches::learn(const RayScene& rays, uint64_t seed) {
  std::vector<std::vector<std::pair<uint32_t, uint32_t>>> lit(patches_.size());
  parallelFor(patches_.size(), 4, [&](size_t p) { lit[p] = lights(rays, static_cast<uint32_t>(p), seed); });
  struct Arrives {
    uint32_t patch;
    float fluxLm;
  };
  std::vector<std::vector<Arrives>> byBrick(kBrickSides * voxels_->bricks.size());
  for (uint32_t p = 0; p < patches_.size(); ++p) {
    for (const auto& [brick, count] : lit[p])
      byBrick[brick].push_back({p, patches_[p].fluxLm * static_cast<float>(count) / static_cast<float>(kRays)});
  }
  std::vector<Seen> found(byBrick.size());
  parallelFor(found.size(), 64, [&](size_t b) {
    std::vector<Arrives> all = byBrick[b];
    const Int3 c = voxels_->bricks[b / kBrickSides].coord;
    for (int k = 0; k < 27; ++k) {
      const int32_t n = k == 13 ? -1 : voxels_->brickAt({c.x + k % 3 - 1, c.y + k / 3 % 3 - 1, c.z + k / 9 - 1});
      if (n < 0) continue;
      for (const Arrives& a : byBrick[kBrickSides * static_cast<size_t>(n) + b % kBrickSides])
        all.push_back({a.patch, kBeside * a.fluxLm});
    }
    std::sort(all.begin(), all.end(), [](const Arrives& x, const Arrives& y) { return x.patch < y.patch; });
    std::vector<Arrives> sums;
    for (const Arrives& a : all) {
      if (sums.empty() || sums.back().patch != a.patch) sums.push_back({a.patch, 0});
      sums.back().fluxLm += a.fluxLm;
    }
    std::sort(sums.begin(), sums.end(), [](const Arrives& x, const Arrives& y) {
      return x.fluxLm != y.fluxLm ? x.fluxLm > y.fluxLm : x.patch < y.patch;
    });
    sums.resize(std::min(sums.size(), kSeen));
    float sum = 0, upTo = 0;
    for (const Arrives& a : sums) sum += a.fluxLm;
    Seen& seen = found[b];
    seen.patch.fill(Seen::kNone), seen.upTo.fill(1), seen.upTo[0] = 0;
    for (const Arrives& a : sums) {
      seen.patch[static_cast<size_t>(seen.count)] = a.patch;
      if (++seen.count < static_cast<int32_t>(sums.size()))
        seen.upTo[static_cast<size_t>(seen.count)] = (upTo += a.fluxLm) / sum;
    }
  });
  seenOfSide_.assign(found.size(), -1);
  for (size_t b = 0; b < found.size(); ++b) {
    if (found[b].count == 0) continue;
    seenOfSide_[b] = static_cast<int32_t>(seen_.size());
    seen_.push_back(found[b]);
  }
}

// 0 where no patch's rays arrive: rays that gather are left to find what little there is.
float BrightPatches::chanceOf(uint32_t patch, int32_t side) const {
  if (side < 0) return byFlux(patch);
  const Seen* seen = seenFrom(side);
  return seen ? kByFlux * byFlux(patch) + (1 - kByFlux) * seen->chance(patch) : 0;
}

// Per steradian at the place that looks: a point is chosen within its patch by flux.
float BrightPatches::pointsDensity(int32_t patch, float radianceCdM2, float distance, float cosLight,
                                   int32_t side) const {
  return kTries * chancePerLumen(patch, side) * kPi * radianceCdM2 * distance * distance / std::max(cosLight, 1e-6f);
}

// Of a point in a patch, by its flux. Glow so faint that no point fell into its patch is stood for by all points.
float BrightPatches::chancePerLumen(int32_t patch, int32_t side) const {
  if (patch < 0) return reaches(side) ? (side < 0 ? 1 : kByFlux) / fluxLm_ : 0;
  return chanceOf(static_cast<uint32_t>(patch), side) / patches_[static_cast<size_t>(patch)].fluxLm;
}

float BrightPatches::densityAt(size_t point, Vec3 p, int32_t side) const {
  const GlowPoint& g = points_[point];
  const Vec3 d = p - g.p;
  const float distance = length(d);
  if (isSun(g) && distance < farM_) return 0;
  return pointsDensity(static_cast<int32_t>(patchOfPoint_[point]), g.radianceCdM2, distance,
                       dot(d, g.n) / std::max(distance, 1e-12f), side);
}

float BrightPatches::pointShare(float density, float rayPdf) { return 1 - powerHeuristic(rayPdf, density); }

float BrightPatches::rayShare(int64_t slot, float radianceCdM2, float distance, float cosLight, int32_t side,
                              float rayPdf) const {
  const float points = pointsDensity(patchOfSlot_[static_cast<size_t>(slot)], radianceCdM2, distance, cosLight, side);
  return powerHeuristic(rayPdf, points);
}

// By a number from 0 to 1, with its chance. `seen`: null where all are possible.
BrightPatches::Choice BrightPatches::patchFor(const Seen* seen, float u) const {
  const float share = seen ? kByFlux : 1;
  if (u < share) {
    const float choice = u / share;
    const auto patch =
        static_cast<uint32_t>(std::min<ptrdiff_t>(std::upper_bound(upTo_.begin(), upTo_.end(), choice) - upTo_.begin(),
                                                  static_cast<ptrdiff_t>(upTo_.size()) - 1));
    return {patch, share * byFlux(patch) + (seen ? (1 - kByFlux) * seen->chance(patch) : 0)};
  }
  const int32_t i = seen->chosen((u - kByFlux) / (1 - kByFlux));
  const uint32_t patch = seen->patch[static_cast<size_t>(i)];
  return {patch, kByFlux * byFlux(patch) + (1 - kByFlux) * seen->chanceOf(i)};
}

BrightPatches::Candidates BrightPatches::draw(int32_t side, Sampler& sampler) const {
  Candidates out;
  if (!reaches(side)) return out;
  const Seen* seen = seenFrom(side);
  const float first = sampler.next1();
  for (out.count = 0; out.count < Candidates::kMost; ++out.count) {
    const float u = (static_cast<float>(out.count) + (out.count == 0 ? first : sampler.fast1())) /
                    static_cast<float>(Candidates::kMost);
    const Choice choice = patchFor(seen, std::min(u, kBelowOne));  // rounding makes 1 of it now and then
    const Patch& of = patches_[choice.patch];
    const uint32_t point =
        of.first + std::min(of.count - 1, static_cast<uint32_t>(sampler.fast1() * static_cast<float>(of.count)));
    __builtin_prefetch(&points_[point]);
    // Chance 0: drawn by rounding, of a patch without flux beside all others.
    out.point[out.count] = point,
    out.perPoint[out.count] = choice.chance > 0 ? static_cast<float>(of.count) / choice.chance : 0;
  }
  return out;
}

// Resampled importance sampling (Talbot et al. 2005).
GlowSample BrightPatches::choose(const Candidates& candidates, Vec3 p, Vec3 n, Sampler& sampler) const {
  std::array<float, Candidates::kMost> gives{}, upTo;  // without shadows; of weights
  float sum = 0;
  for (size_t i = 0; i < candidates.count; ++i) {
    const GlowPoint& g = points_[candidates.point[i]];
    upTo[i] = sum;
    const Vec3 d = g.p - p;
    const float d2 = lengthSquared(d), cosSurface = dot(d, n), cosLight = -dot(d, g.n);
    if (!(candidates.perPoint[i] > 0 && cosSurface > 0 && cosLight > 0) || (isSun(g) && d2 < farM_ * farM_)) continue;
    gives[i] = luminance(g.fluxLm) * cosSurface * cosLight / (d2 * d2);
    upTo[i] = sum += gives[i] * candidates.perPoint[i];
  }
  if (!(sum > 0)) return {};
  const float pick = sampler.next1() * sum;
  size_t k = 0;
  while (k + 1 < candidates.count && (upTo[k] <= pick || !(gives[k] > 0))) ++k;
  if (!(gives[k] > 0)) return {};
  const GlowPoint& g = points_[candidates.point[k]];
  const Vec3 d = g.p - p;
  const float d2 = lengthSquared(d), distance = std::sqrt(d2), cosLight = -dot(d, g.n) / distance;
  GlowSample out;
  out.point = candidates.point[k];
  out.light = {d / distance, distance,
               g.fluxLm * (cosLight / (kPi * d2) * (sum / (static_cast<float>(Candidates::kMost) * gives[k]))), 0};
  return out;
}

size_t BrightPatches::bytes() const {
  return points_.size() * (sizeof(points_[0]) + sizeof(uint32_t)) + patchOfSlot_.size() * (sizeof(int32_t) + 1) +
         patches_.size() * sizeof(Patch) + seen_.size() * sizeof(Seen) + seenOfSide_.size() * sizeof(int32_t);
}

}  // namespace roomlight
