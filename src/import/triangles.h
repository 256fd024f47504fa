// What importers do with triangles and polygons of any format.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "base/vec.h"
#include "scene/scene.h"

namespace roomlight::importers {

// Removes triangles without area: nobody sees them, and no later stage can shade them. Indices must be in range.
// Returns how many.
size_t dropDegenerate(Mesh& mesh);

// Removes triangles with a vertex that is not finite or beyond 1e12, and puts such vertices at the origin. Returns how
// many.
size_t dropInfinite(Mesh& mesh);

// Texture coordinates beyond this, of repeats of a picture, or not finite, say nothing.
constexpr float kFarthestCoordinate = 1e9f;
inline bool saysSomething(Vec2 uv) {  // not of what is no number
  return std::abs(uv.x) <= kFarthestCoordinate && std::abs(uv.y) <= kFarthestCoordinate;
}
constexpr const char* kLostCoordinates = "texture coordinates that are no finite numbers are taken as 0";

// Takes those that say nothing as 0. Returns how many.
size_t mendCoordinates(Mesh& mesh);

// How much cutting by ears all polygons of a file may take: for each the square of its corners at least.
struct EarBudget {
  size_t testsLeft = size_t{1} << 28;  // of corners against ears
  size_t fans = 0;                     // polygons that found nothing left
};

// Corner numbers of the triangles, in the polygon's sense of rotation. Concave polygons are cut by their ears; what is
// left after a great many tries (some thousand corners), or crosses itself, as a fan. Polygons without area give a fan
// too, and those for which nothing of the budget is left.
std::vector<std::array<uint32_t, 3>> triangulate(std::span<const Vec3> corners, EarBudget& budget);
inline std::vector<std::array<uint32_t, 3>> triangulate(std::span<const Vec3> corners) {
  EarBudget budget;
  return triangulate(corners, budget);
}

}  // namespace roomlight::importers
