#include "bake/stitch.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <unordered_map>

namespace roomlight::bake {
namespace {

constexpr float kSameM = 0.00025f;  // what is nearer is at one place,
constexpr float kOnEdgeM = 0.0003f; // and this near to an edge is on it
constexpr float kCellM = 0.05f;

// Places that vertices have, each once.
class Points {
 public:
  uint32_t add(Vec3 p) {
    std::optional<uint32_t> known;
    forEachNear(p, kSameM, [&](uint32_t i) {
      if (!known && length(points_[i] - p) < kSameM) known = i;
    });
    if (known) return *known;
    points_.push_back(p);
    const auto number = static_cast<uint32_t>(points_.size() - 1);
    cells_[keyOf(cellOf(p.x), cellOf(p.y), cellOf(p.z))].push_back(number);
    return number;
  }
  Vec3 operator[](uint32_t i) const { return points_[i]; }

  // What lies on the way between the two, and how far along, in rising order.
  std::vector<std::pair<float, uint32_t>> between(uint32_t a, uint32_t b) const {
    std::vector<std::pair<float, uint32_t>> found;
    const Vec3 from = points_[a], way = points_[b] - from;
    const float l = length(way);
    if (!(l > 2 * kSameM)) return found;
    const int steps = std::max(1, static_cast<int>(std::ceil(l / kCellM)));
    const float reach = 0.5f * l / static_cast<float>(steps) + kOnEdgeM;
    for (int k = 0; k < steps; ++k) {
      const Vec3 middle = from + way * ((static_cast<float>(k) + 0.5f) / static_cast<float>(steps));
      forEachNear(middle, reach, [&](uint32_t i) {
        const Vec3 d = points_[i] - from;
        const float t = dot(d, way) / (l * l);
        if (i == a || i == b || t <= 0 || t >= 1 || length(d - way * t) > kOnEdgeM) return;
        found.emplace_back(t, i);
      });
    }
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
  }

 private:
  static int64_t cellOf(float m) { return static_cast<int64_t>(std::floor(m / kCellM)); }
  static uint64_t keyOf(int64_t x, int64_t y, int64_t z) {
    constexpr uint64_t kMask = (uint64_t{1} << 21) - 1;
    return (static_cast<uint64_t>(x) & kMask) << 42 | (static_cast<uint64_t>(y) & kMask) << 21 |
           (static_cast<uint64_t>(z) & kMask);
  }
  template <class Visit>
  void forEachNear(Vec3 p, float reach, const Visit& visit) const {
    for (int64_t x = cellOf(p.x - reach); x <= cellOf(p.x + reach); ++x) {
      for (int64_t y = cellOf(p.y - reach); y <= cellOf(p.y + reach); ++y) {
        for (int64_t z = cellOf(p.z - reach); z <= cellOf(p.z + reach); ++z) {
          const auto cell = cells_.find(keyOf(x, y, z));
          if (cell == cells_.end()) continue;
          for (const uint32_t i : cell->second) visit(i);
        }
      }
    }
  }
  std::vector<Vec3> points_;
  std::unordered_map<uint64_t, std::vector<uint32_t>> cells_;
};

using OnEdge = std::vector<uint32_t>;  // points, from the first corner to the second

// Splits the triangles of one batch.
class Splitter {
 public:
  Splitter(Batch& batch, const Points& points, std::vector<uint32_t> pointOf)
      : batch_(batch), points_(points), pointOf_(std::move(pointOf)) {}

  void run() {
    const std::vector<uint32_t> before = std::move(batch_.indices);
    batch_.indices.clear();
    for (size_t i = 0; i + 2 < before.size(); i += 3) {
      const std::array<uint32_t, 3> corners{before[i], before[i + 1], before[i + 2]};
      std::array<OnEdge, 3> on;
      if (batch_.vertexLit[corners[0]][0] == 0) {
        for (size_t k = 0; k < 3; ++k) on[k] = onEdge(corners, k);
      }
      split(corners, on);
    }
  }

 private:
  OnEdge onEdge(const std::array<uint32_t, 3>& corners, size_t k) const {
    OnEdge out;
    for (const auto& [t, point] : points_.between(pointOf_[corners[k]], pointOf_[corners[(k + 1) % 3]])) {
      if (point != pointOf_[corners[(k + 2) % 3]]) out.push_back(point);
    }
    return out;
  }

  void split(const std::array<uint32_t, 3>& c, const std::array<OnEdge, 3>& on) {
    for (size_t k = 0; k < 3; ++k) {
      if (on[k].empty()) continue;
      const uint32_t a = c[k], b = c[(k + 1) % 3], opposite = c[(k + 2) % 3];
      const auto middle = on[k].begin() + static_cast<ptrdiff_t>(on[k].size() / 2);
      const uint32_t v = vertexAt(a, b, *middle);
      split({a, v, opposite}, {OnEdge(on[k].begin(), middle), {}, on[(k + 2) % 3]});
      split({v, b, opposite}, {OnEdge(middle + 1, on[k].end()), on[(k + 1) % 3], {}});
      return;
    }
    batch_.indices.insert(batch_.indices.end(), c.begin(), c.end());
  }

  // A vertex between two.
  uint32_t vertexAt(uint32_t a, uint32_t b, uint32_t point) {
    const auto [known, isNew] = made_.try_emplace({std::min(a, b), std::max(a, b), point}, 0);
    if (!isNew) return known->second;
    const Vec3 from = batch_.positions[a], way = batch_.positions[b] - from;
    const float t = std::clamp(dot(points_[point] - from, way) / dot(way, way), 0.0f, 1.0f);
    known->second = static_cast<uint32_t>(batch_.positions.size());
    batch_.positions.push_back(points_[point]);
    batch_.normals.push_back(mixed(batch_.normals[a], batch_.normals[b], t));
    batch_.uv.push_back(batch_.uv[a] * (1 - t) + batch_.uv[b] * t);
    batch_.atlas.push_back(mixed(batch_.atlas[a], batch_.atlas[b], t));
    batch_.colors.push_back(mixed(batch_.colors[a], batch_.colors[b], t));
    batch_.vertexLit.push_back({});
    pointOf_.push_back(point);
    return known->second;
  }
  template <class Numbers>
  static Numbers mixed(const Numbers& a, const Numbers& b, float t) {
    Numbers out{};
    for (size_t k = 0; k < out.size(); ++k)
      out[k] = static_cast<typename Numbers::value_type>(
          std::lround(static_cast<float>(a[k]) * (1 - t) + static_cast<float>(b[k]) * t));
    return out;
  }

  Batch& batch_;
  const Points& points_;
  std::vector<uint32_t> pointOf_;  // of each vertex
  std::map<std::array<uint32_t, 3>, uint32_t> made_;
};

}  // namespace

void stitch(std::span<Batch* const> batches) {
  Points points;
  // What is lit by vertices stays where it is, so that others come to it.
  for (const Batch* batch : batches) {
    for (size_t v = 0; v < batch->positions.size(); ++v) {
      if (batch->vertexLit[v][0] != 0) points.add(batch->positions[v]);
    }
  }
  std::vector<std::vector<uint32_t>> pointOf;
  for (Batch* batch : batches) {
    std::vector<uint32_t>& of = pointOf.emplace_back(batch->positions.size());
    for (size_t v = 0; v < of.size(); ++v) {
      if (batch->vertexLit[v][0] != 0) continue;
      of[v] = points.add(batch->positions[v]);
      batch->positions[v] = points[of[v]];
    }
  }
  for (size_t b = 0; b < batches.size(); ++b) Splitter(*batches[b], points, std::move(pointOf[b])).run();
}

}  // namespace roomlight::bake
