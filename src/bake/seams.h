// Where one chart of an atlas ends and another goes on, on the same surface and with nothing between.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "bake/atlas.h"
#include "trace/ray_scene.h"

namespace roomlight::bake {

constexpr uint32_t kNoElement = std::numeric_limits<uint32_t>::max();

// The element of each texel of an atlas, in rows.
std::vector<uint32_t> elementsByTexel(const Atlas& atlas);

// Refers to the atlas and to the scene that it is of.
class Seams {
 public:
  // `reachTexels`: how far it will be asked beyond a chart's edge.
  Seams(const Atlas& atlas, std::span<const uint32_t> elementAt, const RayScene& rays, float reachTexels);
  // Whether another chart is near that of an element at all.
  bool any(size_t element) const { return !near_[atlas_.chartOf[element]].empty(); }
  // The element of another chart so many texels of its own chart away from an element, or kNoElement.
  uint32_t beyond(size_t element, Vec2 texels) const;
  // What other charts that reach an element on the edge of its own have at its place: elements and weights, which add
  // up to one for each chart.
  std::vector<std::pair<uint32_t, float>> at(size_t element) const;

 private:
  void findNearCharts(float reachTexels);
  // Of a chart: where a place lies on its grid, (0, 0) being the middle of its first texel, and what is there.
  static Vec2 onGrid(const PlacedChart& placed, Vec3 p);
  uint32_t elementOf(uint32_t chart, int column, int row) const;
  // Whether both lie on an arc, with normals as alike (cosine), and nothing stands on it between them.
  bool goesOn(const SurfaceElement& from, const SurfaceElement& to, float alike) const;

  const Atlas& atlas_;
  const std::span<const uint32_t> elementAt_;
  const RayScene& rays_;
  std::vector<std::vector<uint32_t>> near_;  // of each chart: others within reach that face the same way
};

}  // namespace roomlight::bake
