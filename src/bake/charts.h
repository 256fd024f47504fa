// Charts: connected pieces of surface, each of one side and nearly flat, that are laid out on a plane and lit by
// texels; and pieces too fine for that, which are lit by vertices.
#pragma once

#include <cstdint>
#include <vector>

#include "bake/rings.h"
#include "bake/seen_sides.h"
#include "scene/scene.h"

namespace roomlight::bake {

struct ChartSettings {
  float texelM = 0.05f;         // length of an edge
  float fineTexels = 6;         // what is nowhere so long is lit by vertices
  float bendRad = 0.44f;        // between a chart's normal and those of its triangles
  float smallM2 = 0.001f;       // a chart of less area is seen where anything of its piece is
};

struct Chart {
  uint32_t instance = 0;
  bool back = false;     // the side that is lit
  bool byVertices = false;
  uint8_t ring = kNoRing;  // of the ground
  std::vector<uint32_t> triangles;  // of the instance's mesh
  Vec3 normal;  // unit, of the lit side; charts by texels are seen along it
  Vec3 alongU, alongV;  // unit axes of the plane
  Vec2 lowM, sizeM;  // in that plane: the smallest u and v, and the extent
  Vec3 middle;  // of its bounds, world
  float areaM2 = 0;
};

// All that is seen of the scene, but for triangles without area. In the order of the instances. `rings`: of its meshes,
// each ring is a chart of its own; empty: there are none.
std::vector<Chart> chartsOf(const Scene& scene, const SeenSides& seen, const ChartSettings& settings,
                            const Rings& rings = {});

}  // namespace roomlight::bake
