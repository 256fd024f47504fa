#include "gather/hit_guide.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "base/parallel.h"
#include "base/random.h"
#include "base/simd.h"
#include "base/sampling.h"
#include "base/sorted_keys.h"
#include "voxel/voxels.h"

namespace roomlight {
namespace {

constexpr float kMostShare = 0.3f;  // of rays that follow a guide
constexpr size_t kFewest = 8;       // rays that a region learns from
constexpr float kLeastShare = 0.05f;
constexpr float kNarrowest = 0.01f, kWidest = 0.8f;  // sine of a cone's half angle: nearer targets are left to chance
constexpr size_t kMostClusters = 2048;
constexpr float kBelieved = 16;  // rays of its own after which a region believes them as much as those of all
constexpr float kWider = 1.25f, kLeastRadiusM = 0.02f;  // than where rays arrived
constexpr float kFilled = 0.5f;  // of a cluster's disc that surfaces fill
constexpr float kMostSeen = 2;  // times as many rays as should arrive at a cluster
constexpr float kDoubt = 1;  // rays that should arrive before it is doubted whether a cluster is seen
constexpr size_t kKeysOfGuide = 4096;  // keys
constexpr Vec3 kShift{0.271f, 0.713f, 0.459f};

float meanLight(std::span<const GuideRay> rays) {
  double weight = 0, light = 0;
  for (const GuideRay& r : rays) weight += static_cast<double>(r.weight), light += static_cast<double>(r.light);
  return static_cast<float>(light / std::max(weight, 1e-30));
}

}  // namespace

float GuideCones::pdf(Vec3 d) const {
  const Float8 dx(d.x), dy(d.y), dz(d.z);
  Float8 sum;
  for (size_t i = 0; i < static_cast<size_t>(count); i += 8) {
    const Float8 cosine = dx * Float8::load(&x[i]) + dy * Float8::load(&y[i]) + dz * Float8::load(&z[i]);
    sum = sum + ((Float8::load(&cosMost[i]) <= cosine) & Float8::load(&density[i]));
  }
  return dot(sum.low() + sum.high(), Float4(1));
}

Vec3 GuideCones::sample(Vec2 u, float choice) const {
  size_t i = 0;
  while (i + 1 < static_cast<size_t>(count) && upTo[i] <= choice) ++i;
  const float cosine = 1 - u.x * (1 - cosMost[i]), sine = std::sqrt(std::max(0.0f, 1 - cosine * cosine)),
              angle = 2 * kPi * u.y;
  return Frame(Vec3{x[i], y[i], z[i]}).toWorld({sine * std::cos(angle), sine * std::sin(angle), cosine});
}

uint64_t HitGuide::keyOf(Vec3 p, Vec3 n, float cellM) {
  const Vec3 q = p / cellM + kShift;
  const auto whole = [](float v) { return static_cast<uint64_t>(static_cast<int64_t>(std::floor(v))) & 0xfffff; };
  const uint64_t key =
      mix64((whole(q.x) | (whole(q.y) << 20) | (whole(q.z) << 40) | (static_cast<uint64_t>(dominantFace(n)) << 60)) +
            0x9e3779b97f4a7c15ull);
  return key == 0 ? 1 : key;
}

// Cells in which rays of the whole picture arrive and find more than rays do on average.
std::vector<HitGuide::Cluster> HitGuide::clustersOf(std::span<const GuideRay> rays, float cellM) {
  std::vector<uint64_t> keys(rays.size());
  parallelFor(keys.size(), kKeysOfGuide,
              [&](size_t i) { keys[i] = rays[i].arrives ? keyOf(rays[i].to, Vec3(0, 1, 0), cellM) : 0; });
  const float mean = meanLight(rays);
  std::vector<Cluster> out;
  const std::vector<uint32_t> order = sortedBy(keys);
  forRuns(keys, order, [&](size_t begin, size_t end) {
    const auto run = std::span(order).subspan(begin, end - begin);
    if (keys[run[0]] == 0) return;
    Vec3 lo(kInfinity), hi(-kInfinity);
    float weight = 0, light = 0;
    for (const uint32_t i : run)
      lo = min(lo, rays[i].to), hi = max(hi, rays[i].to), weight += rays[i].weight, light += rays[i].light;
    if (light > mean * weight)
      out.push_back(
          {keys[run[0]], (lo + hi) / 2, std::max(kLeastRadiusM, kWider * length(hi - lo) / 2), light / weight});
  });
  const auto gives = [](const Cluster& c) { return c.light * c.radiusM * c.radiusM; };
  std::sort(out.begin(), out.end(), [&](const Cluster& x, const Cluster& y) {
    return gives(x) != gives(y) ? gives(x) > gives(y) : x.key < y.key;
  });
  out.resize(std::min(out.size(), kMostClusters));
  return out;
}

// Targets are clusters that bring a larger share of the light than of the rays: the difference is what chance misses.
// What a cluster could bring without obstacles is known; how much of it is seen is believed the less the more of the
// rays that should have arrived there did not.
HitGuide::Region HitGuide::regionOf(std::span<const GuideRay> rays, std::span<const uint32_t> own,
                                    std::span<const Cluster> clusters, float clusterM, float meanOfAll) {
  Region out;
  Vec3 p, n;
  float weight = 0, light = 0;
  std::vector<uint64_t> arrived;
  for (const uint32_t i : own) {
    const GuideRay& r = rays[i];
    p += r.from, n += r.normal, weight += r.weight, light += r.light;
    if (r.arrives) arrived.push_back(keyOf(r.to, Vec3(0, 1, 0), clusterM));
  }
  const auto count = static_cast<float>(own.size());
  p = p / count, n = normalize(n);
  const float mean = (light + kBelieved * meanOfAll * weight / count) / (weight + kBelieved * weight / count);
  if (!(mean > 0)) return out;
  std::sort(arrived.begin(), arrived.end());
  struct Found {
    uint32_t cluster;
    float misses;
  };
  std::vector<Found> found;
  for (uint32_t c = 0; c < clusters.size(); ++c) {
    const Cluster& k = clusters[c];
    if (k.light <= mean) continue;
    const Vec3 to = k.centre - p;
    const float d2 = std::max(lengthSquared(to), 4 * k.radiusM * k.radiusM),
                cosine = (dot(to, n) + k.radiusM) / std::sqrt(d2);
    if (!(cosine > 0)) continue;
    const float chance = kFilled * std::min(1.0f, cosine) * k.radiusM * k.radiusM / d2;  // of a ray to arrive there
    const auto [first, last] = std::equal_range(arrived.begin(), arrived.end(), k.key);
    const float seen = (static_cast<float>(last - first) + kDoubt) / (count * chance + kDoubt);
    found.push_back({c, chance * std::min(seen, kMostSeen) * (k.light / mean - 1)});
  }
  std::sort(found.begin(), found.end(), [](const Found& a, const Found& b) {
    return a.misses != b.misses ? a.misses > b.misses : a.cluster < b.cluster;
  });
  found.resize(std::min(found.size(), kGuideTargets));
  for (const Found& f : found) {
    const Cluster& k = clusters[f.cluster];
    const auto i = static_cast<size_t>(out.count++);
    out.x[i] = k.centre.x, out.y[i] = k.centre.y, out.z[i] = k.centre.z, out.radiusM[i] = k.radiusM;
    out.weight[i] = f.misses, out.share += f.misses;
  }
  out.share = std::min(out.share, kMostShare);
  if (out.share < kLeastShare) out.count = 0;
  return out;
}

HitGuide::HitGuide(std::span<const GuideRay> rays, float regionM, float clusterM) : regionM_(regionM) {
  const std::vector<Cluster> clusters = clustersOf(rays, clusterM);
  if (clusters.empty()) return;
  const float mean = meanLight(rays);
  std::vector<uint64_t> keys(rays.size()), keyOfRegion;
  parallelFor(keys.size(), kKeysOfGuide, [&](size_t i) { keys[i] = keyOf(rays[i].from, rays[i].normal, regionM_); });
  std::vector<std::vector<uint32_t>> runs;
  const std::vector<uint32_t> order = sortedBy(keys);
  forRuns(keys, order, [&](size_t begin, size_t end) {
    const auto run = std::span(order).subspan(begin, end - begin);
    if (run.size() >= kFewest) runs.emplace_back(run.begin(), run.end()), keyOfRegion.push_back(keys[run[0]]);
  });
  regions_.resize(runs.size());
  parallelFor(runs.size(), 8, [&](size_t r) { regions_[r] = regionOf(rays, runs[r], clusters, clusterM, mean); });
  table_.assign(std::bit_ceil(std::max<size_t>(16, 2 * runs.size())), {});
  const size_t mask = table_.size() - 1;
  for (size_t r = 0; r < runs.size(); ++r) {
    size_t i = keyOfRegion[r] & mask;
    while (table_[i].key != 0) i = (i + 1) & mask;
    table_[i] = {keyOfRegion[r], static_cast<uint32_t>(r)};
  }
}

GuideCones HitGuide::at(Vec3 p, Vec3 n) const {
  GuideCones out;
  if (regions_.empty()) return out;
  const size_t mask = table_.size() - 1;
  const uint64_t key = keyOf(p, n, regionM_);
  size_t at = key & mask;
  while (table_[at].key != 0 && table_[at].key != key) at = (at + 1) & mask;
  if (table_[at].key == 0) return out;
  const Region& region = regions_[table_[at].region];
  float all = 0, sum = 0;
  for (size_t i = 0; i < static_cast<size_t>(region.count); ++i) {
    const Vec3 to = Vec3{region.x[i], region.y[i], region.z[i]} - p;
    const float distance = length(to), sine = std::max(region.radiusM[i] / std::max(distance, 1e-6f), kNarrowest);
    all += region.weight[i];
    if (sine > kWidest || dot(to, n) < -region.radiusM[i]) continue;
    const auto k = static_cast<size_t>(out.count++);
    const float cosMost = std::sqrt(1 - sine * sine);
    out.x[k] = to.x / distance, out.y[k] = to.y / distance, out.z[k] = to.z / distance;
    out.cosMost[k] = cosMost, out.density[k] = region.weight[i];
    out.upTo[k] = sum += region.weight[i];
  }
  if (!(sum > 0)) return out;
  out.share = region.share * sum / all;
  for (size_t k = 0; k < static_cast<size_t>(out.count); ++k) {
    out.upTo[k] /= sum;
    out.density[k] /= sum * 2 * kPi * (1 - out.cosMost[k]);
  }
  for (size_t k = static_cast<size_t>(out.count); k % 8 != 0; ++k)
    out.x[k] = out.y[k] = out.z[k] = out.density[k] = 0, out.cosMost[k] = 1;  // none, for whole steps of eight
  return out;
}

}  // namespace roomlight
