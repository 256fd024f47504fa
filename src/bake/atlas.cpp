#include "bake/atlas.h"

#define STB_RECT_PACK_IMPLEMENTATION
#define STBRP_STATIC
#include <stb/stb_rect_pack.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <unordered_map>

#include "trace/light_layers.h"
#include "trace/surface_point.h"

namespace roomlight::bake {
namespace {

constexpr uint32_t kNone = std::numeric_limits<uint32_t>::max();
constexpr int kGap = 1;                // texels around a chart that repeat its edge
constexpr int kMostOutside = 64;       // texels of an edge of what lies in no room, such as the ground,
constexpr float kLargeM2 = 60;         // or is so large
constexpr int kMost = 1024;            // texels of an edge
constexpr float kAlongStrips = 4;      // so much longer are texels of strips as narrow as one
constexpr float kLongestTexelM = 2, kLongerTexels = 1.4f;  // until an atlas fits
constexpr int kLeastRow = 32, kMostRow = 1024;  // texels of vertices side by side
constexpr float kOffRoomM = 0.1f;      // from a wall, in the room that it faces
constexpr float kLongestFootprintM = 0.3f;  // over which a texel's direct light is averaged
constexpr float kInsideTexels =
    0.75f; // a texel whose middle is so near takes light, at the nearest place of the chart
constexpr float kReachTexels = 1.5f;   // and one so near is read by linear interpolation
constexpr float kOffEdgeM = 0.01f;     // light is taken so far from a triangle's edge, where other things touch it,
constexpr float kOffEdgeShare = 0.15f; // at most so much of the way to its middle

// How a chart lies on its texels.
struct Grid {
  int width, height;  // texels without the gap
  Vec2 perM;          // texels a metre
};

// Large ones outside, such as the ground, are coarse; light varies little along a strip as narrow as a texel.
Grid gridOf(const Chart& chart, float texelM, bool outside) {
  const float narrow = std::min(chart.sizeM.x, chart.sizeM.y) < texelM ? kAlongStrips : 1;
  const int most = outside || chart.areaM2 > kLargeM2 ? kMostOutside : kMost;
  const auto across = [&](float sizeM) {
    return std::clamp(static_cast<int>(std::ceil(std::min(sizeM / (texelM * narrow), 1e6f))) + 1, 2, most);
  };
  const int w = across(chart.sizeM.x), h = across(chart.sizeM.y);
  return {w,
          h,
          {static_cast<float>(w - 1) / std::max(chart.sizeM.x, 1e-6f),
           static_cast<float>(h - 1) / std::max(chart.sizeM.y, 1e-6f)}};
}

Vec2 nearestOnEdge(Vec2 p, Vec2 a, Vec2 b) {
  const Vec2 e = b - a, d = p - a;
  const float l = e.x * e.x + e.y * e.y;
  const float t = l > 0 ? std::clamp((d.x * e.x + d.y * e.y) / l, 0.0f, 1.0f) : 0;
  return a + e * t;
}

float cross2(Vec2 a, Vec2 b) { return a.x * b.y - a.y * b.x; }
float square(Vec2 v) { return v.x * v.x + v.y * v.y; }

// The place of a triangle on the plane that is nearest to p, as barycentric weights of corners 1 and 2.
struct Nearest {
  float distance2, b1, b2;
};
Nearest nearestIn(const std::array<Vec2, 3>& c, Vec2 p) {
  const float area = cross2(c[1] - c[0], c[2] - c[0]);
  const auto weights = [&](Vec2 q) {
    if (std::abs(area) < 1e-12f) return Vec2{1.0f / 3, 1.0f / 3};
    return Vec2{cross2(q - c[0], c[2] - c[0]) / area, cross2(c[1] - c[0], q - c[0]) / area};
  };
  const Vec2 w = weights(p);
  if (w.x >= 0 && w.y >= 0 && w.x + w.y <= 1) return {0, w.x, w.y};
  Nearest best{kInfinity, 0, 0};
  for (size_t k = 0; k < 3; ++k) {
    const Vec2 q = nearestOnEdge(p, c[k], c[(k + 1) % 3]);
    if (const float d = square(q - p); d < best.distance2) {
      const Vec2 at = weights(q);
      best = {d, std::clamp(at.x, 0.0f, 1.0f), std::clamp(at.y, 0.0f, 1.0f)};
    }
  }
  return best;
}

Vec3 towards(Vec3 p, Vec3 middle) {
  const Vec3 d = middle - p;
  const float l = length(d);
  return l > 0 ? p + d * std::min(kOffEdgeShare, kOffEdgeM / l) : p;
}

// Vertices of a chart; those at one place whose normals agree share a texel.
class SharedVertices {
 public:
  struct Place {
    Vec3 position, normal;  // the normal by area
    Vec3 middle;            // of its largest triangle: between several is inside of what is round
    float largest = 0;
  };
  // A corner of a triangle. The number of the vertex in the chart.
  uint32_t add(uint32_t vertex, Vec3 position, Vec3 normal, const std::array<Vec3, 3>& triangle) {
    const auto [entry, isNew] = numbers_.emplace(vertex, static_cast<uint32_t>(vertices_.size()));
    if (isNew) {
      const auto coarse = [](float f) { return std::round(f * kNormalSteps); };
      const std::array key{position.x, position.y, position.z, coarse(normal.x), coarse(normal.y), coarse(normal.z)};
      const auto [place, first] = known_.emplace(key, places_.size());
      if (first) places_.push_back({position, Vec3(0), Vec3(0), 0});
      vertices_.push_back(vertex), placeOf_.push_back(place->second);
    }
    Place& place = places_[placeOf_[entry->second]];
    const float area = length(cross(triangle[1] - triangle[0], triangle[2] - triangle[0]));
    place.normal += normal * area;
    if (area > place.largest) place.middle = (triangle[0] + triangle[1] + triangle[2]) / 3, place.largest = area;
    return entry->second;
  }
  size_t count() const { return vertices_.size(); }
  uint32_t vertex(size_t number) const { return vertices_[number]; }
  size_t placeOf(size_t number) const { return placeOf_[number]; }
  const std::vector<Place>& places() const { return places_; }

 private:
  static constexpr float kNormalSteps = 8;
  std::unordered_map<uint32_t, uint32_t> numbers_;
  std::map<std::array<float, 6>, size_t> known_;
  std::vector<Place> places_;
  std::vector<uint32_t> vertices_;
  std::vector<size_t> placeOf_;
};

// Writes charts into an atlas, one after the other.
class AtlasWriter {
 public:
  AtlasWriter(const Scene& scene, Atlas& atlas) : scene_(scene), atlas_(atlas) {}

  void add(Chart chart, const Grid& grid, int x, int y) {
    const Instance& instance = scene_.instances[chart.instance];
    mesh_ = &scene_.meshes[static_cast<size_t>(instance.mesh)];
    worldFromObject_ = &instance.worldFromObject;
    if (chart.byVertices) {
      addVertices(std::move(chart), grid.width, x, y);
    } else {
      addTexels(std::move(chart), grid, x, y);
    }
  }

 private:
  struct Corner {
    uint32_t triangle = kNone;
    float distance2 = kInfinity, b1 = 0, b2 = 0;
  };

  uint32_t texelAt(int x, int y) const { return static_cast<uint32_t>(y * atlas_.width + x); }
  std::array<uint32_t, 3> cornersOf(const Chart& chart, uint32_t t) const {
    std::array<uint32_t, 3> c{mesh_->indices[3 * t], mesh_->indices[3 * t + 1], mesh_->indices[3 * t + 2]};
    if (chart.back) std::swap(c[1], c[2]);
    return c;
  }
  // Of the lit side, unit. `b1`, `b2`: of the corners as cornersOf() has them.
  Vec3 normalAt(const Chart& chart, uint32_t triangle, Vec3 geometric, float b1, float b2) const {
    if (chart.back) std::swap(b1, b2);
    return smoothNormalAt(*mesh_, *worldFromObject_, {triangle, b1, b2}, geometric);
  }
  static Vec3 geometricNormal(const std::array<Vec3, 3>& p) {
    const Vec3 n = cross(p[1] - p[0], p[2] - p[0]);
    return length(n) > 0 ? normalize(n) : Vec3(0, 1, 0);
  }
  std::array<Vec3, 3> placesOf(const std::array<uint32_t, 3>& c) const {
    return {worldFromObject_->point(mesh_->positions[c[0]]), worldFromObject_->point(mesh_->positions[c[1]]),
            worldFromObject_->point(mesh_->positions[c[2]])};
  }

  void addTexels(Chart chart, const Grid& grid, int x, int y) {
    const int w = grid.width + 2 * kGap, h = grid.height + 2 * kGap;
    const auto onGrid = [&](Vec3 p) {  // texels from the chart's corner; whole numbers are middles
      return Vec2{(dot(p, chart.alongU) - chart.lowM.x) * grid.perM.x + kGap,
                  (dot(p, chart.alongV) - chart.lowM.y) * grid.perM.y + kGap};
    };
    std::vector<Corner> nearest(static_cast<size_t>(w * h));
    for (const uint32_t t : chart.triangles) {
      const std::array<Vec3, 3> p = placesOf(cornersOf(chart, t));
      cover({onGrid(p[0]), onGrid(p[1]), onGrid(p[2])}, t, w, nearest);
    }
    std::vector<uint32_t> elementAt(nearest.size(), kNone);
    for (size_t i = 0; i < nearest.size(); ++i) {
      if (nearest[i].distance2 > kInsideTexels * kInsideTexels) continue;
      const int tx = static_cast<int>(i) % w, ty = static_cast<int>(i) / w;
      if (tx < kGap || ty < kGap || tx >= w - kGap || ty >= h - kGap) continue;
      elementAt[i] = static_cast<uint32_t>(atlas_.elements.size());
      atlas_.elements.push_back(elementIn(chart, nearest[i], texelEdgeM(grid)));
      atlas_.texels.push_back(texelAt(x + tx, y + ty));
    }
    pad(elementAt, nearest, w, {x, y});
    PlacedChart placed;
    std::unordered_map<uint32_t, uint32_t> numbers;
    for (const uint32_t t : chart.triangles) {
      for (const uint32_t v : cornersOf(chart, t)) {
        const auto [entry, isNew] = numbers.emplace(v, static_cast<uint32_t>(placed.vertices.size()));
        if (isNew) {
          const Vec2 q = onGrid(worldFromObject_->point(mesh_->positions[v]));
          placed.vertices.push_back({v, {static_cast<float>(x) + q.x + 0.5f, static_cast<float>(y) + q.y + 0.5f}});
        }
        placed.indices.push_back(entry->second);
      }
    }
    finish(std::move(placed), std::move(chart));
  }

  void finish(PlacedChart placed, Chart chart) {
    atlas_.chartOf.resize(atlas_.elements.size(), static_cast<uint32_t>(atlas_.charts.size()));
    placed.chart = std::move(chart);
    atlas_.charts.push_back(std::move(placed));
  }

  // Keeps for each texel about a triangle where it is nearest.
  static void cover(const std::array<Vec2, 3>& c, uint32_t triangle, int width, std::vector<Corner>& nearest) {
    const int height = static_cast<int>(nearest.size()) / width;
    const auto from = [](float a, float b, float d) {
      return std::max(0, static_cast<int>(std::ceil(std::min({a, b, d}) - kReachTexels)));
    };
    const auto to = [](float a, float b, float d, int end) {
      return std::min(end - 1, static_cast<int>(std::floor(std::max({a, b, d}) + kReachTexels)));
    };
    for (int y = from(c[0].y, c[1].y, c[2].y); y <= to(c[0].y, c[1].y, c[2].y, height); ++y) {
      for (int x = from(c[0].x, c[1].x, c[2].x); x <= to(c[0].x, c[1].x, c[2].x, width); ++x) {
        Corner& best = nearest[static_cast<size_t>(y * width + x)];
        const Nearest here = nearestIn(c, {static_cast<float>(x), static_cast<float>(y)});
        if (here.distance2 < best.distance2) best = {triangle, here.distance2, here.b1, here.b2};
      }
    }
  }

  static float texelEdgeM(const Grid& grid) {
    return std::min(kLongestFootprintM, 1 / std::sqrt(std::max(grid.perM.x * grid.perM.y, 1e-6f)));
  }
  SurfaceElement elementIn(const Chart& chart, const Corner& at, float edgeM) const {
    const std::array<uint32_t, 3> c = cornersOf(chart, at.triangle);
    const std::array<Vec3, 3> p = placesOf(c);
    const Vec3 place = p[0] * (1 - at.b1 - at.b2) + p[1] * at.b1 + p[2] * at.b2;
    return {towards(place, (p[0] + p[1] + p[2]) / 3), normalAt(chart, at.triangle, geometricNormal(p), at.b1, at.b2),
            edgeM};
  }

  // Texels that interpolation reads and no element stands for repeat the nearest one.
  void pad(const std::vector<uint32_t>& elementAt, const std::vector<Corner>& nearest, int width,
           std::pair<int, int> corner) {
    const int height = static_cast<int>(elementAt.size()) / width;
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const size_t i = static_cast<size_t>(y * width + x);
        if (elementAt[i] != kNone || nearest[i].triangle == kNone) continue;
        uint32_t best = kNone;
        int least = std::numeric_limits<int>::max();
        for (int dy = -2; dy <= 2; ++dy) {
          for (int dx = -2; dx <= 2; ++dx) {
            if (x + dx < 0 || y + dy < 0 || x + dx >= width || y + dy >= height) continue;
            const uint32_t element = elementAt[static_cast<size_t>((y + dy) * width + x + dx)];
            if (element != kNone && dx * dx + dy * dy < least) best = element, least = dx * dx + dy * dy;
          }
        }
        if (best != kNone) atlas_.padding.emplace_back(texelAt(corner.first + x, corner.second + y), best);
      }
    }
  }

  void addVertices(Chart chart, int width, int x, int y) {
    PlacedChart placed;
    SharedVertices shared;
    for (const uint32_t t : chart.triangles) {
      const std::array<uint32_t, 3> c = cornersOf(chart, t);
      const std::array<Vec3, 3> p = placesOf(c);
      const Vec3 geometric = geometricNormal(p);
      for (size_t k = 0; k < 3; ++k) {
        const Vec3 n = normalAt(chart, t, geometric, k == 1 ? 1.0f : 0.0f, k == 2 ? 1.0f : 0.0f);
        placed.indices.push_back(shared.add(c[k], p[k], n, p));
      }
    }
    const std::vector<SharedVertices::Place>& places = shared.places();
    const auto texelOf = [&](size_t place) {
      return std::pair{x + static_cast<int>(place) % width, y + static_cast<int>(place) / width};
    };
    for (size_t i = 0; i < places.size(); ++i) {
      const Vec3 normal = length(places[i].normal) > 0 ? normalize(places[i].normal) : chart.normal;
      atlas_.elements.push_back({towards(places[i].position, places[i].middle), normal});
      atlas_.texels.push_back(texelAt(texelOf(i).first, texelOf(i).second));
    }
    for (size_t v = 0; v < shared.count(); ++v) {
      const auto [tx, ty] = texelOf(shared.placeOf(v));
      placed.vertices.push_back({shared.vertex(v), {static_cast<float>(tx) + 0.5f, static_cast<float>(ty) + 0.5f}});
    }
    finish(std::move(placed), std::move(chart));
  }

  const Scene& scene_;
  Atlas& atlas_;
  const Mesh* mesh_ = nullptr;
  const Affine* worldFromObject_ = nullptr;
};

// At most so many texels of vertices: those that share one are told only when they are written.
size_t vertexCount(const Scene& scene, const Chart& chart) {
  const Mesh& mesh = scene.meshes[static_cast<size_t>(scene.instances[chart.instance].mesh)];
  std::vector<uint32_t> vertices;
  for (const uint32_t t : chart.triangles) {
    for (size_t k = 0; k < 3; ++k) vertices.push_back(mesh.indices[3 * t + k]);
  }
  std::sort(vertices.begin(), vertices.end());
  return static_cast<size_t>(std::unique(vertices.begin(), vertices.end()) - vertices.begin());
}

// Where charts will lie.
struct Layout {
  std::vector<size_t> order;  // of charts, by room
  std::vector<Grid> grids;
  std::vector<stbrp_rect> rects;
  int width = 0, height = 0;
};

// Vertices in about a square.
Grid vertexGrid(size_t count) {
  const int row = std::clamp(static_cast<int>(std::ceil(std::sqrt(static_cast<double>(count)))), kLeastRow, kMostRow);
  const auto n = static_cast<int>(count);
  return {std::min(n, row), (n + row - 1) / row, {}};
}

Layout layoutOf(const Scene& scene, const std::vector<Chart>& charts, const AtlasSettings& settings) {
  std::map<int, std::vector<size_t>> byRoom;
  for (size_t i = 0; i < charts.size(); ++i)
    byRoom[roomAt(scene, charts[i].middle + charts[i].normal * kOffRoomM)].push_back(i);
  Layout out;
  out.width = settings.width;
  for (const auto& [room, members] : byRoom) {
    std::vector<stbrp_rect> rects;
    for (const size_t i : members) {
      const bool fine = charts[i].byVertices;
      const Grid grid = fine ? vertexGrid(vertexCount(scene, charts[i])) : gridOf(charts[i], settings.texelM, room < 0);
      const int gap = fine ? 0 : 2 * kGap;
      rects.push_back({static_cast<int>(out.grids.size()), grid.width + gap, grid.height + gap, 0, 0, 0});
      out.grids.push_back(grid), out.order.push_back(i);
    }
    stbrp_context context;
    std::vector<stbrp_node> nodes(static_cast<size_t>(settings.width));
    stbrp_init_target(&context, settings.width, std::numeric_limits<int>::max() / 2, nodes.data(), settings.width);
    stbrp_pack_rects(&context, rects.data(), static_cast<int>(rects.size()));
    int used = 0;
    for (stbrp_rect& rect : rects) used = std::max(used, rect.y + rect.h), rect.y += out.height;
    out.rects.insert(out.rects.end(), rects.begin(), rects.end());
    out.height += (used + settings.tile - 1) / settings.tile * settings.tile;
  }
  return out;
}

}  // namespace

Result<Atlas> atlasOf(const Scene& scene, std::vector<Chart> charts, AtlasSettings settings) {
  Layout layout = layoutOf(scene, charts, settings);
  while (layout.height > kMostAtlasEdge) {
    if (settings.width >= kMostAtlasEdge) settings.texelM *= kLongerTexels;
    settings.width = kMostAtlasEdge;
    if (settings.texelM > kLongestTexelM)
      return Error{"the home has more fine surfaces than a graphics chip holds light for; leave some out"};
    layout = layoutOf(scene, charts, settings);
  }
  Atlas atlas;
  atlas.width = layout.width, atlas.height = layout.height;
  AtlasWriter writer(scene, atlas);
  for (const stbrp_rect& rect : layout.rects) {
    const auto k = static_cast<size_t>(rect.id);
    writer.add(std::move(charts[layout.order[k]]), layout.grids[k], rect.x, rect.y);
  }
  return atlas;
}

}  // namespace roomlight::bake
