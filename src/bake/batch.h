// Triangles that are drawn at once, before they are written.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/vec.h"

namespace roomlight::bake {

struct Batch {
  // Of each vertex.
  std::vector<Vec3> positions;
  std::vector<std::array<int8_t, 4>> normals;
  std::vector<Vec2> uv;
  std::vector<std::array<uint16_t, 2>> atlas;  // normalised
  std::vector<std::array<uint8_t, 4>> colors, vertexLit;
  std::vector<uint32_t> indices;  // three a triangle
  bool coloured = false;
};

}  // namespace roomlight::bake
