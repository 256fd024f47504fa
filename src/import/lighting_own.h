// Lamps that a scene has itself, as a lighting file changes them (docs/reference/lighting.md, `own`). What is wrong is
 // told to the place; see json_reader.h.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "import/json_reader.h"
#include "scene/scene.h"

namespace roomlight {

struct OwnLamp {
  std::string name;
  size_t number = 1;  // of those of the name, in the scene's order
  double dimming = 1, factor = 1;
  std::optional<Vec3> color;  // of luminance 1
  std::optional<float> temperatureK;
  std::optional<Vec3> position, direction;  // of a lamp without a body
};

std::vector<OwnLamp> readOwnLamps(const JsonPlace& j);

// "": every lamp is there. Else what is wrong.
std::string missingLamp(const std::vector<OwnLamp>& own, const Scene& scene);

void applyOwnLamps(const std::vector<OwnLamp>& own, Scene& scene);

}  // namespace roomlight
