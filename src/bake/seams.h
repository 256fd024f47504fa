// Where one chart of an atlas ends and another goes on, on the same surface and with nothing between.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "bake/atlas.h"
#include "trace/ray_scene.h"

namespace roomlight::bake {

// Refers to the atlas and to the scene that it is of. What is buried (LitPlaces) goes nowhere: its light is that of
// another place.
class Seams {
 public:
  Seams(const Atlas& atlas, std::span<const uint32_t> elementAt, std::span<const uint8_t> buried, const RayScene& rays);
  // Whether the chart of an element touches another one.
  bool any(size_t element) const { return !touching_[atlas_.chartOf[element]].empty(); }
  // The element of a touching chart that is so many texels of its own chart away from an element, or kNoElement.
  uint32_t beyond(size_t element, Vec2 texels) const;
  // What each touching chart has at the place of an element on the edge of both: elements and weights, which add up to
  // one.
  std::vector<std::vector<std::pair<uint32_t, float>>> at(size_t element) const;

 private:
  std::vector<std::vector<uint32_t>> nearCharts() const;
  bool reaches(uint32_t chart, size_t element) const;
  // Of a chart: where a place lies on its grid, (0, 0) being the middle of its first texel, and what is there.
  static Vec2 onGrid(const PlacedChart& placed, Vec3 p);
  uint32_t elementOf(uint32_t chart, int column, int row) const;
  // Whether both lie on an arc, with normals as alike (cosine), and nothing stands on it between them.
  bool goesOn(size_t from, size_t to, float alike) const;

  const Atlas& atlas_;
  const std::span<const uint32_t> elementAt_;
  const std::span<const uint8_t> buried_;
  const RayScene& rays_;
  std::vector<std::vector<uint32_t>> touching_;  // of each chart: others that have one of its places and face its way
};

}  // namespace roomlight::bake
