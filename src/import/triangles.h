// What importers do with triangles of any format.
#pragma once

#include <cmath>

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

}  // namespace roomlight::importers
