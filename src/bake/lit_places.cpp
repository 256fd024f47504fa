#include "bake/lit_places.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "base/parallel.h"
#include "base/sampler.h"
#include "base/sampling.h"
#include "trace/surface_point.h"

namespace roomlight::bake {
namespace {

constexpr int kRaysEach = 16, kRaysInDoubt = 64, kFewOpen = 4;
constexpr float kOpenShare = 0.08f;    // of what a place sees, that can be seen from a room, at least
constexpr float kCoverM = 0.04f;       // what nobody sees and is so near covers a place, as a picture does the wall,
constexpr float kCoveredShare = 0.7f;  // if more of its rays than this end there
constexpr float kSteps = 1.5f;       // of a component of normals that share a place, each way from zero
constexpr float kFacing = 0.3f;  // cosine between the normals of a vertex and of a place that lights it, at least

// For each element of a chart by texels the nearest one of it, along texels, that is not buried; kNoElement: there is
// none.
std::vector<uint32_t> nearestOpen(const Atlas& atlas, const std::vector<uint8_t>& buried) {
  const size_t n = atlas.elements.size();
  const std::vector<uint32_t> elementAt = elementsByTexel(atlas);
  std::vector<uint32_t> nearest(n, kNoElement);
  std::vector<uint32_t> ring;
  for (uint32_t i = 0; i < n; ++i) {
    if (!buried[i]) nearest[i] = i, ring.push_back(i);
  }
  const int64_t w = atlas.width;
  for (size_t k = 0; k < ring.size(); ++k) {
    const uint32_t i = ring[k];
    for (const int64_t step : {int64_t{-1}, int64_t{1}, -w, w}) {
      const int64_t texel = static_cast<int64_t>(atlas.texels[i]) + step;
      if (texel < 0 || texel >= static_cast<int64_t>(elementAt.size())) continue;
      const uint32_t next = elementAt[static_cast<size_t>(texel)];
      if (next == kNoElement || nearest[next] != kNoElement || atlas.chartOf[next] != atlas.chartOf[i]) continue;
      nearest[next] = nearest[i], ring.push_back(next);
    }
  }
  return nearest;
}

// Places of one fine piece, by cell and direction.
class Clusters {
 public:
  explicit Clusters(float apartM) : apartM_(apartM) {}
  void add(const SurfaceElement& e) {
    Cluster& c = clusters_[keyOf(e)];
    c.position += e.position, c.normal += e.normal, c.count += 1;
    // Of what was added the one nearest to the mean would be better still; the first is on the surface, a mean is not.
    if (c.count == 1) c.first = e;
  }
  void finish(std::vector<SurfaceElement>& places) {
    for (auto& [key, c] : clusters_) {
      c.place = static_cast<uint32_t>(places.size());
      places.push_back({c.first.position, length(c.normal) > 0.1f ? normalize(c.normal) : c.first.normal});
    }
  }
  LightShares sharesOf(const SurfaceElement& e, const std::vector<SurfaceElement>& places) const {
    std::vector<std::pair<float, uint32_t>> found;
    const Key own = keyOf(e);
    for (int x = own.cell[0] - 1; x <= own.cell[0] + 1; ++x) {
      for (int y = own.cell[1] - 1; y <= own.cell[1] + 1; ++y) {
        auto near = clusters_.lower_bound({x, y, own.cell[2] - 1});
        for (; near != clusters_.end() && near->first.cell[0] == x && near->first.cell[1] == y; ++near) {
          if (near->first.cell[2] > own.cell[2] + 1) break;
          const SurfaceElement& place = places[near->second.place];
          const float facing = dot(place.normal, e.normal), apart = length(place.position - e.position) / apartM_;
          if (facing < kFacing || apart > 1.5f) continue;
          found.emplace_back(facing * facing / (apart * apart + 0.02f), near->second.place);
        }
      }
    }
    if (found.empty()) return {{nearestTo(e, places)}, {1}};
    std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) {
      return std::tuple(-a.first, a.second) < std::tuple(-b.first, b.second);
    });
    LightShares shares;
    float sum = 0;
    for (size_t k = 0; k < std::min(kMostShares, found.size()); ++k)
      shares.place[k] = found[k].second, shares.weight[k] = found[k].first, sum += found[k].first;
    for (float& w : shares.weight) w /= sum;
    return shares;
  }

 private:
  // Of those that face the same way, if any does.
  uint32_t nearestTo(const SurfaceElement& e, const std::vector<SurfaceElement>& places) const {
    uint32_t best = clusters_.begin()->second.place;
    float least = kInfinity;
    for (const auto& [key, c] : clusters_) {
      const SurfaceElement& place = places[c.place];
      const float apart = length(place.position - e.position) + (dot(place.normal, e.normal) > 0 ? 0 : kBehindM);
      if (apart < least) best = c.place, least = apart;
    }
    return best;
  }
  static constexpr int kLowest = std::numeric_limits<int>::min();
  static constexpr float kBehindM = 1000;
  struct Key {
    std::array<int, 3> cell;
    std::array<int, 3> facing{kLowest, kLowest, kLowest};
    Key(int x, int y, int z) : cell{x, y, z} {}
    auto operator<=>(const Key&) const = default;
  };
  struct Cluster {
    Vec3 position, normal;
    SurfaceElement first;
    float count = 0;
    uint32_t place = 0;
  };
  Key keyOf(const SurfaceElement& e) const {
    const auto cell = [&](float p) { return static_cast<int>(std::floor(p / apartM_)); };
    Key key(cell(e.position.x), cell(e.position.y), cell(e.position.z));
    for (int c = 0; c < 3; ++c)
      key.facing[static_cast<size_t>(c)] = static_cast<int>(std::lround(e.normal[c] * kSteps));
    return key;
  }
  const float apartM_;
  std::map<Key, Cluster> clusters_;
};

}  // namespace

bool isBuried(const SurfaceElement& e, size_t number, const RayScene& rays, const SeenSides& seen) {
  const Frame frame(e.normal);
  const Vec3 origin = offsetOrigin(e.position, e.normal);
  int open = 0, covered = 0, traced = 0;
  const auto trace = [&](int rayCount) {
    for (; traced < rayCount; ++traced) {
      Sampler sampler(number, static_cast<uint32_t>(traced), 0);
      const Ray ray{origin, frame.toWorld(sampleCosineHemisphere(sampler.next2()))};
      const Hit hit = rays.intersect(ray);
      if (!hit.valid() || seen.seen(hit.instance, hit.triangle, meetsBack(rays.scene(), hit, ray.direction))) {
        ++open;
      } else if (hit.t < kCoverM) {
        ++covered;
      }
    }
  };
  trace(kRaysEach);
  // A wall that goes on above the ceiling sees the same of others there: they are seen, further down.
  if (open > 0 && open < kFewOpen) trace(kRaysInDoubt);
  return static_cast<float>(open) < kOpenShare * static_cast<float>(traced) ||
         static_cast<float>(covered) > kCoveredShare * static_cast<float>(traced);
}

LitPlaces litPlacesOf(const Atlas& atlas, const RayScene& rays, const SeenSides& seen, float apartM) {
  const size_t n = atlas.elements.size();
  std::vector<uint8_t> buried(n);
  parallelFor(n, 256, [&](size_t i) { buried[i] = isBuried(atlas.elements[i], i, rays, seen); });
  const std::vector<uint32_t> open = nearestOpen(atlas, buried);
  LitPlaces out;
  out.ofElement.resize(n);
  std::vector<uint32_t> placeOf(n, kNoElement);
  for (size_t first = 0; first < n;) {
    size_t end = first;
    while (end < n && atlas.chartOf[end] == atlas.chartOf[first]) ++end;
    if (atlas.charts[atlas.chartOf[first]].chart.byVertices) {
      Clusters clusters(apartM);
      const bool anyOpen = std::any_of(&buried[first], &buried[first] + (end - first), [](uint8_t b) { return !b; });
      for (size_t i = first; i < end; ++i) {
        if (!anyOpen || !buried[i]) clusters.add(atlas.elements[i]);
      }
      clusters.finish(out.places);
      parallelFor(end - first, 256, [&](size_t k) {
        out.ofElement[first + k] = clusters.sharesOf(atlas.elements[first + k], out.places);
      });
    } else {
      for (size_t i = first; i < end; ++i) {
        if (open[i] != i && open[i] != kNoElement) continue;
        placeOf[i] = static_cast<uint32_t>(out.places.size());
        out.places.push_back(atlas.elements[i]);
      }
      for (size_t i = first; i < end; ++i) out.ofElement[i] = {{placeOf[open[i] == kNoElement ? i : open[i]]}, {1}};
    }
    const Chart& chart = atlas.charts[atlas.chartOf[first]].chart;
    out.sides.resize(out.places.size(), {chart.instance, chart.back, chart.byVertices, atlas.chartOf[first]});
    first = end;
  }
  out.buried = std::move(buried);
  return out;
}

}  // namespace roomlight::bake
