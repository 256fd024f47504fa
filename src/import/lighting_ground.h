// The ground of a lighting file (docs/reference/lighting.md). What is wrong is told to the place; see json_reader.h.
#pragma once

#include "import/json_reader.h"
#include "scene/scene.h"

namespace roomlight {

// A level disc that things stand on, grey, matt.
struct Ground {
  Vec3 centre;  // m
  float radiusM = 1;
  float reflectance = 0.2f;
};

Ground readGround(const JsonPlace& j);

// As an object of its own, "Ground".
void addGround(const Ground& ground, Scene& scene);

}  // namespace roomlight
