#include "gather/hit_cache.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "base/parallel.h"
#include "base/random.h"
#include "base/sorted_keys.h"
#include "gather/layer_light.h"
#include "voxel/voxels.h"

namespace roomlight {
namespace {

constexpr float kLift = 0.1f;               // cells: for places to see one another along a bent surface
constexpr size_t kKeysAtOnce = 4096;             // keys
constexpr Vec3 kShift{0.377f, 0.619f,
                      0.283f};  // smallest cells: surfaces of homes stand on round coordinates, borders of cells do not

}  // namespace

uint64_t HitCache::keyOf(const HitPlace& place, int level) const {
  const float perMetre = 1 / (cellM_ * static_cast<float>(1 << level));
  const Vec3 q = (place.p + kShift * cellM_) * perMetre;  // cells of a level are parts of those of the next
  const auto whole = [](float v) { return static_cast<uint64_t>(static_cast<int64_t>(std::floor(v))) & 0x1fffff; };
  const uint64_t cell = whole(q.x) | (whole(q.y) << 21) | (whole(q.z) << 42);
  const uint64_t kind = (uint64_t{place.instance} << 8) | (static_cast<uint64_t>(dominantFace(place.n)) << 4) |
                        static_cast<uint64_t>(level);
  const uint64_t key = mix64(mix64(cell + 0x9e3779b97f4a7c15ull) ^ (kind * 0xd6e8feb86659fd93ull));
  return key == 0 ? 1 : key;
}

std::vector<HitCache::Chosen> HitCache::chosen(std::span<const HitPlace> places, size_t most) const {
  std::vector<uint64_t> keys(places.size());
  parallelFor(keys.size(), kKeysAtOnce, [&](size_t i) { keys[i] = keyOf(places[i], 0); });
  const std::vector<uint32_t> order = sortedBy(keys);
  std::vector<Chosen> out;
  forRuns(keys, order, [&](size_t begin, size_t end) {
    const size_t n = std::min(most, end - begin);
    for (size_t k = 0; k < n; ++k)
      out.push_back({order[begin + k * (end - begin) / n],
                     static_cast<float>(end - begin) / static_cast<float>(n)});  // from all over the picture
  });
  return out;
}

Ray HitCache::between(const HitCell& cell, const HitPlace& place) {
  const Vec3 from = place.p + place.n * (kLift * cell.sizeM);
  return {from, cell.place + cell.normal * (kLift * cell.sizeM) - from, 0, 1};
}

void HitCache::fill(const RayScene& rays, std::span<const LitHit> samples, const HitLayers* layers) {
  cells_.clear(), keys_.clear(), shares_.clear();
  std::vector<uint8_t> covered(samples.size());
  for (int level = 0; level < kLevels; ++level) fillLevel(rays, samples, layers, level, covered);
  makeTable(keys_);
}

// Cells of one level, where finer ones leave samples over.
void HitCache::fillLevel(const RayScene& rays, std::span<const LitHit> samples, const HitLayers* layers, int level,
                         std::vector<uint8_t>& covered) {
  const size_t fewest = level + 1 < kLevels ? kFewest : 1;
  std::vector<uint64_t> keys(samples.size());
  parallelFor(keys.size(), kKeysAtOnce, [&](size_t i) { keys[i] = keyOf(samples[i].at, level); });
  const std::vector<uint32_t> order = sortedBy(keys);
  struct Run {
    size_t begin, end;
  };
  std::vector<Run> runs;
  forRuns(keys, order, [&](size_t begin, size_t end) {
    bool all = true;
    for (size_t k = begin; k < end; ++k) all = all && covered[order[k]];
    if (!all && end - begin >= fewest) runs.push_back({begin, end});
  });
  const size_t firstCell = cells_.size();
  std::vector<Ray> ways;
  std::vector<Vec3> left;
  for (const Run& run : runs) {
    HitCell cell;
    const LitHit& first = samples[order[run.begin]];
    cell.place = first.at.p, cell.normal = first.at.n, cell.slot = first.slot;
    cell.sizeM = cellM_ * static_cast<float>(1 << level);
    cell.sure = cell.sizeM <= voxelM_;
    for (size_t k = run.begin; k < run.end; ++k) cell.sure = cell.sure && samples[order[k]].sure;
    if (!cell.sure) {
      for (size_t k = run.begin; k < run.end; ++k) ways.push_back(between(cell, samples[order[k]].at));
    }
    cells_.push_back(cell);
  }
  left.resize(ways.size());
  rays.transmittance(ways, left);
  size_t way = 0, kept = firstCell;
  for (size_t r = 0; r < runs.size(); ++r) {
    HitCell cell = cells_[firstCell + r];
    float n = 0;
    std::vector<uint32_t> members;
    for (size_t k = runs[r].begin; k < runs[r].end; ++k) {
      if (!cell.sure && k != runs[r].begin && !(luminance(left[way + k - runs[r].begin]) > 0.25f)) continue;
      const LitHit& s = samples[order[k]];
      const Vec3 sent = s.even + s.rare + s.sharp;
      cell.radianceCdM2 += s.albedo * sent, cell.ownCdM2 += s.own, cell.lux += kPi * luminance(sent),
          cell.ownLux += kPi * luminance(s.own), cell.sunLux += s.sunLux, n += 1;
      members.push_back(order[k]);
    }
    if (!cell.sure) way += runs[r].end - runs[r].begin;
    if (members.size() < fewest) continue;
    for (const uint32_t m : members) covered[m] = 1;
    cell.radianceCdM2 = cell.radianceCdM2 / n, cell.ownCdM2 = cell.ownCdM2 / n, cell.lux /= n, cell.ownLux /= n,
    cell.sunLux /= n;
    if (layers) cell.shares = static_cast<uint32_t>(shares_.size()), layers->addShares(samples, members, shares_);
    cells_[kept++] = cell;
    keys_.push_back(keys[order[runs[r].begin]]);
  }
  cells_.resize(kept);
}

void HitCache::makeTable(std::span<const uint64_t> keys) {
  table_.assign(std::bit_ceil(std::max<size_t>(16, 2 * keys.size())), {});
  for (size_t i = 0; i < keys.size(); ++i) insert(keys[i], static_cast<uint32_t>(i));
}

void HitCache::insert(uint64_t key, uint32_t cell) {
  const size_t mask = table_.size() - 1;
  size_t i = key & mask;
  while (table_[i].key != 0 && table_[i].key != key) i = (i + 1) & mask;
  table_[i] = {key, cell};
}

const HitCell* HitCache::find(const HitPlace& place) const {
  if (cells_.empty()) return nullptr;
  const size_t mask = table_.size() - 1;
  for (int level = 0; level < kLevels; ++level) {
    const uint64_t key = keyOf(place, level);
    for (size_t i = key & mask; table_[i].key != 0; i = (i + 1) & mask) {
      if (table_[i].key == key) return &cells_[table_[i].cell];
    }
  }
  return nullptr;
}

void HitCache::prefetch(std::span<const HitPlace> places) const {
  if (cells_.empty()) return;
  const size_t mask = table_.size() - 1;
  constexpr size_t kAtOnce = 64;
  std::array<const Entry*, kAtOnce> entry;
  for (; !places.empty(); places = places.subspan(std::min(kAtOnce, places.size()))) {
    const size_t n = std::min(kAtOnce, places.size());
    for (size_t i = 0; i < n; ++i) __builtin_prefetch(entry[i] = &table_[keyOf(places[i], 0) & mask]);
    for (size_t i = 0; i < n; ++i) __builtin_prefetch(&cells_[entry[i]->cell]);
  }
}

}  // namespace roomlight
