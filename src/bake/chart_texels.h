// A chart on a grid of texels, or of finer cells: where in the home the middle of each is.
#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "bake/chart_border.h"
#include "bake/charts.h"
#include "trace/meter.h"

namespace roomlight::bake {

constexpr int kGap = 1;  // texels around a chart that repeat its edge

// How a chart lies on its texels: the middles of the first and the last lie on its edges.
struct ChartGrid {
  int width = 0, height = 0;  // texels without the gap
  Vec2 perM;                  // texels a metre
};

// The triangles of a chart, seen from the lit side.
class ChartSurface {
 public:
  ChartSurface(const Scene& scene, const Chart& chart);
  // Vertices of the mesh, counter-clockwise.
  std::array<uint32_t, 3> cornersOf(uint32_t triangle) const;
  std::array<Vec3, 3> placesOf(const std::array<uint32_t, 3>& corners) const;
  // Of the lit side, unit. `b1`, `b2`: weights of the corners as cornersOf() has them.
  Vec3 normalAt(uint32_t triangle, Vec3 geometric, float b1, float b2) const;
  static Vec3 geometricNormal(const std::array<Vec3, 3>& p);
  const Mesh& mesh() const { return *mesh_; }
  const Affine& worldFromObject() const { return *worldFromObject_; }

 private:
  const bool back_;
  const Mesh* mesh_;
  const Affine* worldFromObject_;
};

// How far light is taken from a triangle's edge, where other things touch it.
struct OffEdge {
  float distanceM = 0.01f;  // towards the triangle's middle,
  float share = 0.15f;      // at most so much of the way
};
Vec3 offEdge(Vec3 p, Vec3 middle, OffEdge off = {});

// Cells of a chart by texels, in rows, the gap included: `fine` x `fine` of them a texel.
class ChartTexels {
 public:
  // Refers to the surface. Cells further than `reachTexels` from the chart are on no triangle.
  ChartTexels(const ChartSurface& surface, const Chart& chart, const ChartGrid& grid, int fine, float reachTexels);
  int width() const { return width_; }    // cells
  int height() const { return height_; }
  size_t count() const { return nearest_.size(); }
  // From the middle of a cell to the nearest place of the chart, in texels; infinite where that is out of reach.
  float distanceTexels(size_t cell) const;
  bool onTriangle(size_t cell) const { return nearest_[cell].triangle != kNone; }
  // That place, `off` the chart's edges: across them, for the middle of a long triangle lies along them. Where that
  // does not move it, towards the middle of its triangle. Needs onTriangle().
  SurfaceElement element(size_t cell, OffEdge off) const;
  bool covers(size_t cell) const { return nearest_[cell].distance2 <= 0; }  // the middle of a cell
  // A place of the world in texels from the upper left of the gap; (0, 0) is the middle of a texel.
  Vec2 onGrid(Vec3 p) const;

 private:
  static constexpr uint32_t kNone = 0xffffffffu;
  struct Corner {
    uint32_t triangle = kNone;
    float distance2 = kInfinity, b1 = 0, b2 = 0;
  };
  void cover(uint32_t triangle);
  std::array<Vec2, 3> onPlane(uint32_t triangle) const;  // m along the chart's axes
  Corner insetAt(size_t cell, OffEdge off) const;
  float inCells(float texels) const { return (texels + 0.5f) * static_cast<float>(fine_) - 0.5f; }

  const ChartSurface& surface_;
  const Chart& chart_;
  const ChartGrid grid_;
  ChartBorder border_;  // empty where there are too many triangles
  std::vector<std::array<Vec2, 3>> planeOf_;  // of them, m along the chart's axes
  const int fine_, width_, height_;
  const float reachTexels_;
  std::vector<Corner> nearest_;  // distances in cells
};

// The place that stands for a texel: its own, unless its normal is not that of most of its square. A rounded edge is
// not the face beside it. `cells`: of the same chart and grid, kCellsATexel a texel; not asked where all normals are
// alike.
constexpr int kCellsATexel = 4;  // even: none has its middle on the edge of a face
bool normalsAreAlike(const ChartSurface& surface, const Chart& chart);
SurfaceElement typicalElement(const ChartTexels& texels, const ChartTexels& cells, size_t texel);

}  // namespace roomlight::bake
