// The ground and the windows of a lighting file (docs/reference/lighting.md). What is wrong is told to the place; see
// json/json_reader.h.
#pragma once

#include <string>
#include <vector>

#include "json/json_reader.h"
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

struct GlazedMaterial {
  std::string material;  // name in the scene
  Glazing glazing;
};

std::vector<GlazedMaterial> readGlazing(const JsonPlace& j);

// "": every material is there. Else what is wrong.
std::string missingMaterial(const std::vector<GlazedMaterial>& glazing, const Scene& scene);

void applyGlazing(const std::vector<GlazedMaterial>& glazing, Scene& scene);

}  // namespace roomlight
