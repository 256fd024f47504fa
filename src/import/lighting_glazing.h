// Windows of a lighting file (docs/reference/lighting.md). What is wrong is told to the place; see json_reader.h.
#pragma once

#include <string>
#include <vector>

#include "import/json_reader.h"
#include "scene/scene.h"

namespace roomlight {

struct GlazedMaterial {
  std::string material;  // name in the scene
  Glazing glazing;
};

std::vector<GlazedMaterial> readGlazing(const JsonPlace& j);

// "": every material is there. Else what is wrong.
std::string missingMaterial(const std::vector<GlazedMaterial>& glazing, const Scene& scene);

void applyGlazing(const std::vector<GlazedMaterial>& glazing, Scene& scene);

}  // namespace roomlight
