// Lamps of a lighting file (docs/reference/lighting.md): those that it adds, and those of the scene that it changes.
// What is wrong is told to the place; see json/json_reader.h.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "import/photometric_file.h"
#include "json/json_reader.h"
#include "scene/scene.h"

namespace roomlight::importers {

// A lamp that the file adds. `number`: its place in the list, from 0; a lamp without a name is called by it.
// Photometric files go by absolute path or relative to `folder`.
Lamp readLamp(const JsonPlace& j, size_t number, const std::filesystem::path& folder, PhotometricFiles& files);

}  // namespace roomlight::importers

namespace roomlight {

// A lamp that the scene has itself, as the file changes it (`own`).
struct OwnLamp {
  std::string name;
  size_t number = 1;  // of those of the name, in the scene's order
  double dimming = 1, factor = 1;
  std::optional<double> fluxLm;  // instead of the scene's; of a lamp without a surface that shines
  std::optional<Vec3> color;  // of luminance 1
  std::optional<float> temperatureK;
  std::optional<Vec3> position, direction;  // of a lamp without a body
};

std::vector<OwnLamp> readOwnLamps(const JsonPlace& j);

// "": every lamp is there. Else what is wrong.
std::string missingLamp(const std::vector<OwnLamp>& own, const Scene& scene);

void applyOwnLamps(const std::vector<OwnLamp>& own, Scene& scene);

}  // namespace roomlight
