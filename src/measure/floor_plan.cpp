#include "measure/drawings.h"

#include <cmath>
#include <map>
#include <set>

namespace roomlight {
namespace {

constexpr float kRasterM = 0.01f, kShortestM = 0.04f;
constexpr size_t kMostPoints = 20'000;

using Node = std::pair<int, int>;  // on the raster
struct Segment {
  Vec2 a, b;
};

// Cut off what lies outside of the frame (Liang & Barsky 1984). False: nothing is left.
bool clip(Segment& s, Vec2 low, Vec2 high) {
  float t0 = 0, t1 = 1;
  const Vec2 d = s.b - s.a;
  const float p[4] = {-d.x, d.x, -d.y, d.y}, q[4] = {s.a.x - low.x, high.x - s.a.x, s.a.y - low.y, high.y - s.a.y};
  for (int i = 0; i < 4; ++i) {
    if (p[i] == 0 && q[i] < 0) return false;
    if (p[i] < 0) t0 = std::max(t0, q[i] / p[i]);
    if (p[i] > 0) t1 = std::min(t1, q[i] / p[i]);
  }
  if (t0 >= t1) return false;
  s = {s.a + d * t0, s.a + d * t1};
  return true;
}

std::vector<Segment> cut(const Scene& scene, const PlanFrame& frame) {
  std::vector<Segment> list;
  const float y = frame.origin.y;
  const auto flat = [&](Vec3 p) { return Vec2{dot(p - frame.origin, frame.u), dot(p - frame.origin, frame.v)}; };
  for (const Instance& instance : scene.instances) {
    const Bounds3 b = instanceBounds(scene, instance);
    if (b.empty() || b.lo.y > y || b.hi.y < y) continue;
    const Mesh& mesh = scene.meshes[static_cast<size_t>(instance.mesh)];
    for (size_t t = 0; t < mesh.triangleCount(); ++t) {
      Vec3 p[3];
      for (size_t k = 0; k < 3; ++k) p[k] = instance.worldFromObject.point(mesh.positions[mesh.indices[3 * t + k]]);
      Vec2 ends[3];
      int count = 0;
      for (int k = 0; k < 3; ++k) {
        const Vec3 from = p[k], to = p[(k + 1) % 3];
        if ((from.y >= y) != (to.y >= y)) ends[count++] = flat(from + (to - from) * ((y - from.y) / (to.y - from.y)));
      }
      Segment s{ends[0], ends[1]};
      if (count == 2 && clip(s, frame.low, frame.high)) list.push_back(s);
    }
  }
  return list;
}

// Walks along segments that share ends; points on a straight line are left out.
std::vector<PlanLine> joined(const std::vector<Segment>& segments, float rasterM) {
  const auto node = [&](Vec2 p) {
    return Node{static_cast<int>(std::lround(p.x / rasterM)), static_cast<int>(std::lround(p.y / rasterM))};
  };
  std::map<Node, std::set<Node>> links;
  for (const Segment& s : segments) {
    const Node a = node(s.a), b = node(s.b);
    if (a != b) links[a].insert(b), links[b].insert(a);
  }
  std::vector<PlanLine> lines;
  for (auto& [start, ends] : links) {
    while (!ends.empty()) {
      std::vector<Node> line = {start};
      for (auto from = links.find(start); !from->second.empty();) {
        const Node to = *from->second.begin();
        from->second.erase(from->second.begin());
        const auto next = links.find(to);
        next->second.erase(from->first);
        const size_t n = line.size();
        const bool straight = n >= 2 && (line[n - 1].first - line[n - 2].first) * (to.second - line[n - 1].second) ==
                                            (line[n - 1].second - line[n - 2].second) * (to.first - line[n - 1].first);
        if (straight) line.pop_back();
        line.push_back(to);
        from = next;
      }
      Node low = line[0], high = line[0];
      for (const auto& [x, z] : line)
        low = {std::min(low.first, x), std::min(low.second, z)},
        high = {std::max(high.first, x), std::max(high.second, z)};
      if (static_cast<float>(std::max(high.first - low.first, high.second - low.second)) * rasterM < kShortestM)
        continue;
      PlanLine out;
      for (const auto& [x, z] : line) out.push_back({static_cast<float>(x) * rasterM, static_cast<float>(z) * rasterM});
      lines.push_back(std::move(out));
    }
  }
  return lines;
}

}  // namespace

std::vector<PlanLine> cutPlan(const Scene& scene, const PlanFrame& frame) {
  const std::vector<Segment> segments = cut(scene, frame);
  for (float raster = kRasterM;; raster *= 2) {
    std::vector<PlanLine> lines = joined(segments, raster);
    size_t points = 0;
    for (const PlanLine& line : lines) points += line.size();
    if (points <= kMostPoints || raster > 1) return lines;
  }
}

}  // namespace roomlight
