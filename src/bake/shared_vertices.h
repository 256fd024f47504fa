// Vertices of fine things that take the same light.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <unordered_map>
#include <vector>

#include "bake/charts.h"

namespace roomlight::bake {

// Vertices of a chart; those in one cell whose normals agree share a place.
class SharedVertices {
 public:
  struct Place {
    Vec3 position, middle;  // of the largest triangle: its corner, and its middle
    Vec3 normal;            // by area
    float largest = 0;
  };
  // `cellM` 0: only those at the same position.
  explicit SharedVertices(float cellM) : cellM_(cellM) {}
  // A corner of a triangle. The number of the vertex in the chart.
  uint32_t add(uint32_t vertex, Vec3 position, Vec3 normal, const std::array<Vec3, 3>& triangle);
  size_t count() const { return vertices_.size(); }
  uint32_t vertex(size_t number) const { return vertices_[number]; }
  size_t placeOf(size_t number) const { return placeOf_[number]; }
  const std::vector<Place>& places() const { return places_; }

 private:
  const float cellM_;
  std::unordered_map<uint32_t, uint32_t> numbers_;
  std::map<std::array<float, 6>, size_t> known_;
  std::vector<Place> places_;
  std::vector<uint32_t> vertices_;
  std::vector<size_t> placeOf_;
};

// Of a chart by vertices. `corners`: numbers of the vertices, three a triangle.
SharedVertices sharedVerticesOf(const Scene& scene, const Chart& chart, float cellM,
                                std::vector<uint32_t>* corners = nullptr);

}  // namespace roomlight::bake
