#include "bake/charts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "trace/surface_point.h"

namespace roomlight::bake {
namespace {

constexpr uint32_t kNone = std::numeric_limits<uint32_t>::max();

// Triangles of one instance in the world, and which of them share an edge of the same corners.
struct Patchwork {
  uint32_t instance;
  std::vector<TriangleVertices> corners;
  std::vector<Vec3> normals;  // unit; zero without area
  std::vector<float> areasM2;
  std::vector<std::array<uint32_t, 3>> neighbours;  // kNone: none
  std::vector<uint32_t> piece;  // of connected triangles, by its first
  std::vector<uint8_t> ring;
  size_t size() const { return corners.size(); }
};

// Corners at one place have one number, whichever vertices they are.
std::vector<uint32_t> weldedVertices(const Mesh& mesh) {
  std::vector<uint32_t> order(mesh.positions.size()), welded(mesh.positions.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto key = [&](uint32_t i) {
    const Vec3 p = mesh.positions[i];
    return std::array{p.x, p.y, p.z};
  };
  std::sort(order.begin(), order.end(),
            [&](uint32_t a, uint32_t b) { return std::pair(key(a), a) < std::pair(key(b), b); });
  for (size_t i = 0; i < order.size(); ++i)
    welded[order[i]] = i > 0 && key(order[i]) == key(order[i - 1]) ? welded[order[i - 1]] : order[i];
  return welded;
}

void joinNeighbours(const Mesh& mesh, Patchwork& work) {
  const std::vector<uint32_t> welded = weldedVertices(mesh);
  struct Edge {
    uint64_t corners;
    uint32_t triangle, side;
  };
  std::vector<Edge> edges;
  for (uint32_t t = 0; t < work.size(); ++t) {
    if (work.areasM2[t] <= 0) continue;
    for (uint32_t k = 0; k < 3; ++k) {
      const uint32_t a = welded[mesh.indices[3 * t + k]], b = welded[mesh.indices[3 * t + (k + 1) % 3]];
      edges.push_back({static_cast<uint64_t>(std::min(a, b)) << 32 | std::max(a, b), t, k});
    }
  }
  std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
    return std::tuple(a.corners, a.triangle, a.side) < std::tuple(b.corners, b.triangle, b.side);
  });
  const auto cornersOf = [&](uint32_t t) {
    std::array corners{welded[mesh.indices[3 * t]], welded[mesh.indices[3 * t + 1]], welded[mesh.indices[3 * t + 2]]};
    std::sort(corners.begin(), corners.end());
    return corners;
  };
  // Where more than two meet, one after the other.
  for (size_t i = 0; i + 1 < edges.size(); ++i) {
    const Edge &a = edges[i], &b = edges[i + 1];
    if (a.corners != b.corners || a.triangle == b.triangle) continue;
    if (cornersOf(a.triangle) == cornersOf(b.triangle)) continue;  // one lies on the other
    if (work.neighbours[a.triangle][a.side] != kNone) continue;
    work.neighbours[a.triangle][a.side] = b.triangle;
    work.neighbours[b.triangle][b.side] = a.triangle;
  }
}

void findPieces(Patchwork& work) {
  work.piece.assign(work.size(), kNone);
  std::vector<uint32_t> open;
  for (uint32_t first = 0; first < work.size(); ++first) {
    if (work.piece[first] != kNone) continue;
    open.assign(1, first), work.piece[first] = first;
    while (!open.empty()) {
      const uint32_t t = open.back();
      open.pop_back();
      for (const uint32_t n : work.neighbours[t]) {
        if (n != kNone && work.piece[n] == kNone) work.piece[n] = first, open.push_back(n);
      }
    }
  }
}

Patchwork patchworkOf(const Scene& scene, uint32_t instance, const Rings& rings) {
  const Mesh& mesh = scene.meshes[static_cast<size_t>(scene.instances[instance].mesh)];
  Patchwork work{instance, {}, {}, {}, {}, {}, {}};
  for (uint32_t t = 0; t < mesh.triangleCount(); ++t) {
    const TriangleVertices v = worldTriangle(scene, instance, t);
    const Vec3 n = cross(v.b - v.a, v.c - v.a);
    const float twice = length(n);
    const bool valid = std::isfinite(twice) && twice > 1e-10f;
    work.corners.push_back(v);
    work.normals.push_back(valid ? n / twice : Vec3(0));
    work.areasM2.push_back(valid ? twice / 2 : 0);
    work.neighbours.push_back({kNone, kNone, kNone});
  }
  const auto number = static_cast<size_t>(scene.instances[instance].mesh);
  if (!rings.empty()) work.ring = rings[number];
  work.ring.resize(work.size(), kNoRing);
  joinNeighbours(mesh, work);
  findPieces(work);
  return work;
}

// Along its longest border, so that rectangles lie straight.
void layOnPlane(const Patchwork& work, Chart& chart) {
  std::vector<uint32_t> members = chart.triangles;
  std::sort(members.begin(), members.end());
  Vec3 longest{1, 0, 0};
  float most = 0;
  for (const uint32_t t : members) {
    const TriangleVertices& v = work.corners[t];
    const Vec3 edges[] = {v.b - v.a, v.c - v.b, v.a - v.c};
    for (size_t k = 0; k < 3; ++k) {
      const uint32_t beside = work.neighbours[t][k];
      if (beside != kNone && std::binary_search(members.begin(), members.end(), beside)) continue;
      if (const float l = length(edges[k]); l > most) most = l, longest = edges[k];
    }
  }
  const Vec3 along = longest - chart.normal * dot(longest, chart.normal);
  chart.alongU = length(along) > 1e-6f ? normalize(along) : Frame(chart.normal).t;
  chart.alongV = cross(chart.normal, chart.alongU);
  Vec2 low{kInfinity, kInfinity}, high{-kInfinity, -kInfinity};
  Bounds3 bounds;
  for (const uint32_t t : chart.triangles) {
    const TriangleVertices& v = work.corners[t];
    for (const Vec3 p : {v.a, v.b, v.c}) {
      const Vec2 q{dot(p, chart.alongU), dot(p, chart.alongV)};
      low = {std::min(low.x, q.x), std::min(low.y, q.y)}, high = {std::max(high.x, q.x), std::max(high.y, q.y)};
      bounds.add(p);
    }
  }
  chart.lowM = low, chart.sizeM = high - low, chart.middle = bounds.centre();
}

// Grows charts over one side of a patchwork.
class ChartMaker {
 public:
  ChartMaker(const Patchwork& work, const SeenSides& seen, const ChartSettings& settings)
      : work_(work), seen_(seen), settings_(settings) {}

  void add(bool back, std::vector<Chart>& charts) {
    taken_.assign(work_.size(), false);
    std::vector<bool> pieceSeen(work_.size(), false);
    for (uint32_t t = 0; t < work_.size(); ++t) {
      if (seen_.seen(work_.instance, t, back)) pieceSeen[work_.piece[t]] = true;
    }
    Chart fine;
    for (const uint32_t first : largestFirst()) {
      if (taken_[first] || work_.areasM2[first] <= 0 || !pieceSeen[work_.piece[first]]) continue;
      Chart chart = grown(first, back);
      if (!isSeen(chart)) continue;
      if (isFine(chart)) {
        fine.triangles.insert(fine.triangles.end(), chart.triangles.begin(), chart.triangles.end());
        fine.areaM2 += chart.areaM2;
        continue;
      }
      charts.push_back(std::move(chart));
    }
    if (fine.triangles.empty()) return;
    fine.instance = work_.instance, fine.back = back, fine.byVertices = true;
    fine.normal = work_.normals[fine.triangles.front()] * (back ? -1.0f : 1.0f);
    std::sort(fine.triangles.begin(), fine.triangles.end());
    layOnPlane(work_, fine);
    charts.push_back(std::move(fine));
  }

 private:
  std::vector<uint32_t> largestFirst() const {
    std::vector<uint32_t> order(work_.size());
    std::iota(order.begin(), order.end(), 0u);
    std::stable_sort(order.begin(), order.end(),
                     [&](uint32_t a, uint32_t b) { return work_.areasM2[a] > work_.areasM2[b]; });
    return order;
  }
  Chart grown(uint32_t first, bool back) {
    Chart chart;
    chart.instance = work_.instance, chart.back = back, chart.ring = work_.ring[first];
    const Vec3 n = work_.normals[first];
    const float least = std::cos(settings_.bendRad);
    chart.triangles.assign(1, first), taken_[first] = true;
    for (size_t i = 0; i < chart.triangles.size(); ++i) {
      const uint32_t t = chart.triangles[i];
      chart.areaM2 += work_.areasM2[t];
      for (const uint32_t next : work_.neighbours[t]) {
        if (next == kNone || taken_[next] || work_.ring[next] != chart.ring) continue;
        if (dot(work_.normals[next], n) < least) continue;
        taken_[next] = true, chart.triangles.push_back(next);
      }
    }
    chart.normal = back ? -n : n;
    layOnPlane(work_, chart);
    return chart;
  }
  bool isSeen(const Chart& chart) const {
    return chart.areaM2 < settings_.smallM2 ||
           std::any_of(chart.triangles.begin(), chart.triangles.end(),
                       [&](uint32_t t) { return seen_.seen(work_.instance, t, chart.back); });
  }
  bool isFine(const Chart& chart) const {
    const float texels = settings_.fineTexels;
    return chart.ring == kNoRing && std::max(chart.sizeM.x, chart.sizeM.y) < texels * settings_.texelM;
  }

  const Patchwork& work_;
  const SeenSides& seen_;
  const ChartSettings& settings_;
  std::vector<bool> taken_;
};

}  // namespace

std::vector<Chart> chartsOf(const Scene& scene, const SeenSides& seen, const ChartSettings& settings,
                            const Rings& rings) {
  std::vector<Chart> charts;
  for (uint32_t i = 0; i < scene.instances.size(); ++i) {
    const Patchwork work = patchworkOf(scene, i, rings);
    ChartMaker maker(work, seen, settings);
    maker.add(false, charts);
    maker.add(true, charts);
  }
  return charts;
}

}  // namespace roomlight::bake
