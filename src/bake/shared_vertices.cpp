#include "bake/shared_vertices.h"

#include <cmath>

#include "bake/chart_texels.h"

namespace roomlight::bake {
namespace {

constexpr float kNormalSteps = 8, kNormalStepsOfCells = 4;

}  // namespace

uint32_t SharedVertices::add(uint32_t vertex, Vec3 position, Vec3 normal, const std::array<Vec3, 3>& triangle) {
  const auto [entry, isNew] = numbers_.emplace(vertex, static_cast<uint32_t>(vertices_.size()));
  if (isNew) {
    const Vec3 cell = cellM_ > 0 ? position / cellM_ : position;
    const auto at = [&](float f) { return cellM_ > 0 ? std::floor(f) : f; };
    const auto coarse = [&](float f) { return std::round(f * (cellM_ > 0 ? kNormalStepsOfCells : kNormalSteps)); };
    const std::array key{at(cell.x), at(cell.y), at(cell.z), coarse(normal.x), coarse(normal.y), coarse(normal.z)};
    const auto [place, first] = known_.emplace(key, places_.size());
    if (first) places_.push_back({position, position, Vec3(0), 0});
    vertices_.push_back(vertex), placeOf_.push_back(place->second);
  }
  Place& place = places_[placeOf_[entry->second]];
  const float area = length(cross(triangle[1] - triangle[0], triangle[2] - triangle[0]));
  place.normal += normal * area;
  if (area > place.largest) {
    // Both of one triangle: the way from one to the other leads along the surface.
    place.position = position, place.middle = (triangle[0] + triangle[1] + triangle[2]) / 3;
    place.largest = area;
  }
  return entry->second;
}

SharedVertices sharedVerticesOf(const Scene& scene, const Chart& chart, float cellM, std::vector<uint32_t>* corners) {
  SharedVertices shared(cellM);
  const ChartSurface surface(scene, chart);
  for (const uint32_t t : chart.triangles) {
    const std::array<uint32_t, 3> c = surface.cornersOf(t);
    const std::array<Vec3, 3> p = surface.placesOf(c);
    const Vec3 geometric = ChartSurface::geometricNormal(p);
    for (size_t k = 0; k < 3; ++k) {
      const Vec3 n = surface.normalAt(t, geometric, k == 1 ? 1.0f : 0.0f, k == 2 ? 1.0f : 0.0f);
      const uint32_t number = shared.add(c[k], p[k], n, p);
      if (corners) corners->push_back(number);
    }
  }
  return shared;
}

}  // namespace roomlight::bake
