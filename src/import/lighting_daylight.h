// Sun and sky that belong together, from the `daylight` of a lighting file (docs/reference/lighting.md). What is wrong
// is told to the place; see json_reader.h.
#pragma once

#include <filesystem>

#include "import/json_reader.h"
#include "scene/scene.h"

namespace roomlight {

struct Daylight {
  Sun sun;  // black where clouds hide it or it is below the horizon
  Sky sky;  // black at night
};

// By the sky's kind, or by measured irradiance and Perez's all-weather sky. `folder`: where the path of a weather file
// begins.
Daylight readDaylight(const JsonPlace& j, const std::filesystem::path& folder);

}  // namespace roomlight
