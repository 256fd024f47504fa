#include "bake/atlas.h"

#define STB_RECT_PACK_IMPLEMENTATION
#define STBRP_STATIC
#include <stb/stb_rect_pack.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <unordered_map>

#include "bake/shared_vertices.h"
#include "trace/light_layers.h"

namespace roomlight::bake {
namespace {

constexpr int kMostNearThings = 128;  // likewise, where things stand on it
constexpr float kLargeM2 = 60;        // what is so large counts as outside
constexpr int kMost = 1024;            // texels of an edge
constexpr float kAlongStrips = 4;      // so much longer are texels of strips as narrow as one
constexpr float kLongestTexelM = 2, kLongerTexels = 1.4f;  // until an atlas fits
constexpr int kLeastRow = 32, kMostRow = 1024;  // texels of vertices side by side
constexpr float kOffRoomM = 0.1f;      // from a wall, in the room that it faces
constexpr float kInsideTexels =
    0.75f; // a texel whose middle is so near takes light, at the nearest place of the chart
constexpr float kReachTexels = 1.5f;   // and one so near is read by linear interpolation

// Large ones outside, such as the ground, are coarse; light varies little along a strip as narrow as a texel.
ChartGrid gridOf(const Chart& chart, float texelM, bool outside) {
  const float narrow = std::min(chart.sizeM.x, chart.sizeM.y) < texelM ? kAlongStrips : 1;
  const int mostCoarse = chart.ring == 0 ? kMostNearThings : kMostOutside;
  const int most = outside || chart.areaM2 > kLargeM2 ? mostCoarse : kMost;
  const auto across = [&](float sizeM) {
    return std::clamp(static_cast<int>(std::ceil(std::min(sizeM / (texelM * narrow), 1e6f))) + 1, 2, most);
  };
  const int w = across(chart.sizeM.x), h = across(chart.sizeM.y);
  return {w,
          h,
          {static_cast<float>(w - 1) / std::max(chart.sizeM.x, 1e-6f),
           static_cast<float>(h - 1) / std::max(chart.sizeM.y, 1e-6f)}};
}

// How near to each other vertices of a fine thing share a texel.
float shareM(const AtlasSettings& settings, const Chart& chart) {
  return settings.vertexM * (settings.coarser.empty() ? 1 : settings.coarser[chart.instance]);
}

// Writes charts into an atlas, one after the other.
class AtlasWriter {
 public:
  AtlasWriter(const Scene& scene, const AtlasSettings& settings, Atlas& atlas)
      : scene_(scene), settings_(settings), atlas_(atlas) {}

  void add(Chart chart, const ChartGrid& grid, int x, int y) {
    if (chart.byVertices) {
      addVertices(std::move(chart), grid.width, x, y);
    } else {
      addTexels(std::move(chart), grid, x, y);
    }
  }

 private:
  uint32_t texelAt(int x, int y) const { return static_cast<uint32_t>(y * atlas_.width + x); }

  void addTexels(Chart chart, const ChartGrid& grid, int x, int y) {
    const ChartSurface surface(scene_, chart);
    const ChartTexels texels(surface, chart, grid, 1, kReachTexels);
    std::optional<ChartTexels> cells;
    if (!normalsAreAlike(surface, chart)) cells.emplace(surface, chart, grid, kCellsATexel, 0.0f);
    const int w = texels.width(), h = texels.height();
    std::vector<uint32_t> elementAt(texels.count(), kNoElement);
    for (size_t i = 0; i < texels.count(); ++i) {
      if (texels.distanceTexels(i) > kInsideTexels) continue;
      const int tx = static_cast<int>(i) % w, ty = static_cast<int>(i) / w;
      if (tx < kGap || ty < kGap || tx >= w - kGap || ty >= h - kGap) continue;
      elementAt[i] = static_cast<uint32_t>(atlas_.elements.size());
      atlas_.elements.push_back(cells ? typicalElement(texels, *cells, i) : texels.element(i, {}));
      atlas_.texels.push_back(texelAt(x + tx, y + ty));
    }
    pad(elementAt, texels, {x, y});
    PlacedChart placed;
    placed.grid = grid, placed.left = x, placed.top = y;
    std::unordered_map<uint32_t, uint32_t> numbers;
    for (const uint32_t t : chart.triangles) {
      for (const uint32_t v : surface.cornersOf(t)) {
        const auto [entry, isNew] = numbers.emplace(v, static_cast<uint32_t>(placed.vertices.size()));
        if (isNew) {
          const Vec2 q = texels.onGrid(surface.worldFromObject().point(surface.mesh().positions[v]));
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

  // Texels that interpolation reads and no element stands for repeat the nearest one.
  void pad(const std::vector<uint32_t>& elementAt, const ChartTexels& texels, std::pair<int, int> corner) {
    const int width = texels.width(), height = texels.height();
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const size_t i = static_cast<size_t>(y * width + x);
        if (elementAt[i] != kNoElement || !texels.onTriangle(i)) continue;
        uint32_t best = kNoElement;
        int least = std::numeric_limits<int>::max();
        for (int dy = -2; dy <= 2; ++dy) {
          for (int dx = -2; dx <= 2; ++dx) {
            if (x + dx < 0 || y + dy < 0 || x + dx >= width || y + dy >= height) continue;
            const uint32_t element = elementAt[static_cast<size_t>((y + dy) * width + x + dx)];
            if (element != kNoElement && dx * dx + dy * dy < least) best = element, least = dx * dx + dy * dy;
          }
        }
        if (best != kNoElement) atlas_.padding.emplace_back(texelAt(corner.first + x, corner.second + y), best);
      }
    }
  }

  void addVertices(Chart chart, int width, int x, int y) {
    PlacedChart placed;
    const SharedVertices shared = sharedVerticesOf(scene_, chart, shareM(settings_, chart), &placed.indices);
    const std::vector<SharedVertices::Place>& places = shared.places();
    const auto texelOf = [&](size_t place) {
      return std::pair{x + static_cast<int>(place) % width, y + static_cast<int>(place) / width};
    };
    for (size_t i = 0; i < places.size(); ++i) {
      const Vec3 normal = length(places[i].normal) > 0 ? normalize(places[i].normal) : chart.normal;
      atlas_.elements.push_back({offEdge(places[i].position, places[i].middle), normal});
      atlas_.texels.push_back(texelAt(texelOf(i).first, texelOf(i).second));
    }
    for (size_t v = 0; v < shared.count(); ++v) {
      const auto [tx, ty] = texelOf(shared.placeOf(v));
      placed.vertices.push_back({shared.vertex(v), {static_cast<float>(tx) + 0.5f, static_cast<float>(ty) + 0.5f}});
    }
    finish(std::move(placed), std::move(chart));
  }

  const Scene& scene_;
  const AtlasSettings& settings_;
  Atlas& atlas_;
};

// Where charts will lie.
struct Layout {
  std::vector<size_t> order;  // of charts, by room
  std::vector<ChartGrid> grids;
  std::vector<stbrp_rect> rects;
  int width = 0, height = 0;
};

// Vertices in about a square.
ChartGrid vertexGrid(size_t count) {
  const int row = std::clamp(static_cast<int>(std::ceil(std::sqrt(static_cast<double>(count)))), kLeastRow, kMostRow);
  const auto n = static_cast<int>(count);
  return {std::min(n, row), (n + row - 1) / row, {}};
}

// `apart`: each room in rows of tiles of its own.
Layout layoutOf(const Scene& scene, const std::vector<Chart>& charts, const AtlasSettings& settings, bool apart) {
  std::vector<int> rooms;
  std::map<int, std::vector<size_t>> groups;
  for (size_t i = 0; i < charts.size(); ++i) {
    rooms.push_back(roomAt(scene, charts[i].middle + charts[i].normal * kOffRoomM));
    groups[apart ? rooms.back() : 0].push_back(i);
  }
  Layout out;
  out.width = settings.width;
  for (const auto& [group, members] : groups) {
    std::vector<stbrp_rect> rects;
    for (const size_t i : members) {
      const bool fine = charts[i].byVertices;
      const ChartGrid grid =
          fine ? vertexGrid(sharedVerticesOf(scene, charts[i], shareM(settings, charts[i])).places().size())
               : gridOf(charts[i], settings.texelM, rooms[i] < 0);
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

std::vector<uint32_t> elementsByTexel(const Atlas& atlas) {
  std::vector<uint32_t> out(static_cast<size_t>(atlas.width) * static_cast<size_t>(atlas.height), kNoElement);
  for (size_t i = 0; i < atlas.texels.size(); ++i) out[atlas.texels[i]] = static_cast<uint32_t>(i);
  return out;
}

Result<Atlas> atlasOf(const Scene& scene, std::vector<Chart> charts, AtlasSettings settings) {
  bool apart = true;
  Layout layout = layoutOf(scene, charts, settings, apart);
  while (layout.height > kMostAtlasEdge) {
    if (settings.width < kMostAtlasEdge) {
      settings.width = kMostAtlasEdge;
    } else if (apart) {
      apart = false;  // many rooms leave the ends of many rows empty
    } else {
      settings.texelM *= kLongerTexels;
    }
    if (settings.texelM > kLongestTexelM)
      return Error{"the home has more fine surfaces than a graphics chip holds light for; leave some out"};
    layout = layoutOf(scene, charts, settings, apart);
  }
  Atlas atlas;
  atlas.width = layout.width, atlas.height = layout.height;
  AtlasWriter writer(scene, settings, atlas);
  for (const stbrp_rect& rect : layout.rects) {
    const auto k = static_cast<size_t>(rect.id);
    writer.add(std::move(charts[layout.order[k]]), layout.grids[k], rect.x, rect.y);
  }
  return atlas;
}

}  // namespace roomlight::bake
