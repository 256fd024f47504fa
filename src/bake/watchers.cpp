#include "bake/watchers.h"

#include <algorithm>
#include <cmath>

namespace roomlight::bake {
namespace {

constexpr float kCellM = 1;
constexpr size_t kFirst = 4, kOthers = 20;  // eyes of a cell
constexpr float kMostCells = 1 << 20;       // along an axis, either way

}  // namespace

uint64_t Watchers::cellOf(Vec3 p) {
  uint64_t key = 0;
  for (const float x : {p.x, p.y, p.z}) {
    const float cell = std::clamp(std::floor(x / kCellM), -kMostCells, kMostCells - 1);
    key = key << 21 | static_cast<uint64_t>(cell + kMostCells);
  }
  return key;
}

Watchers::Watchers(std::vector<Sighting> sightings) {
  std::sort(sightings.begin(), sightings.end());
  sightings.erase(std::unique(sightings.begin(), sightings.end()), sightings.end());
  for (size_t i = 0, end = 0; i < sightings.size(); i = end) {
    const uint64_t key = sightings[i].cell;
    for (end = i; end < sightings.size() && sightings[end].cell == key; ++end) {}
    const size_t count = end - i, kept = std::min(count, kFirst + kOthers);
    cells_.push_back({key, eyes_.size(), kept});
    for (size_t k = 0; k < kept; ++k) {
      const size_t spread = kFirst + (k - std::min(k, kFirst)) * (count - std::min(count, kFirst)) / kOthers;
      eyes_.push_back(sightings[i + (k < kFirst || count == kept ? k : spread)].eye);
    }
  }
}

std::span<const uint32_t> Watchers::of(Vec3 p) const {
  const uint64_t key = cellOf(p);
  const auto at =
      std::lower_bound(cells_.begin(), cells_.end(), key, [](const Cell& c, uint64_t k) { return c.key < k; });
  if (at == cells_.end() || at->key != key) return {};
  return {eyes_.data() + at->first, at->count};
}

}  // namespace roomlight::bake
