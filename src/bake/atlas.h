// The atlas of light: where each chart lies, which texels take light, and where in the home they are.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "bake/chart_texels.h"
#include "bake/charts.h"
#include "base/result.h"
#include "trace/meter.h"

namespace roomlight::bake {

constexpr int kMostOutside = 64;       // texels of an edge of what lies in no room, such as the ground
constexpr int kMostAtlasEdge = 4096;  // texels: what graphics chips of old phones hold

struct AtlasSettings {
  float texelM = 0.05f;
  int width = 2048;  // texels, a multiple of the tile
  int tile = 32;     // texels; rooms begin with new rows of tiles, where that fits
  float vertexM = 0.02f;       // about so near to each other vertices of fine things share a texel,
  std::vector<float> coarser = {};  // times this, by instance; empty: 1
};

// A corner of a lit triangle: a vertex of an instance's mesh on one side.
struct AtlasVertex {
  uint32_t vertex = 0;  // of the mesh
  Vec2 texel;  // place in the atlas, in texels from its top left; (0.5, 0.5) is the middle of the first
};

struct PlacedChart {
  Chart chart;
  ChartGrid grid;         // of charts by texels,
  int left = 0, top = 0;  // whose gap begins with this texel of the atlas
  std::vector<AtlasVertex> vertices;
  std::vector<uint32_t> indices;  // three a triangle, into `vertices`; counter-clockwise seen from the lit side
};

struct Atlas {
  int width = 0, height = 0;
  std::vector<PlacedChart> charts;
  std::vector<SurfaceElement> elements;  // that take light
  std::vector<uint32_t> texels;          // of each element: its texel, y * width + x
  std::vector<uint32_t> chartOf;         // and its chart
  // Texels beside those that repeat the light of an element, against what lies beyond a chart's edge: (texel, element).
  std::vector<std::pair<uint32_t, uint32_t>> padding;
};

constexpr uint32_t kNoElement = std::numeric_limits<uint32_t>::max();
// The element of each texel of an atlas, in rows.
std::vector<uint32_t> elementsByTexel(const Atlas& atlas);

// Lays the charts out, those in one room together. Where that would be higher than kMostAtlasEdge, the atlas is as wide
// as that, and texels are longer. Errors: vertices alone are too many.
Result<Atlas> atlasOf(const Scene& scene, std::vector<Chart> charts, AtlasSettings settings);

}  // namespace roomlight::bake
