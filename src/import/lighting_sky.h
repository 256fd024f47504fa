// Sun and sky of a lighting file (docs/reference/lighting.md). What is wrong is told to the place; see json_reader.h.
#pragma once

#include <filesystem>

#include "import/json_reader.h"
#include "photometry/sun.h"
#include "scene/scene.h"

namespace roomlight {

// By direction with its illuminance, or by place and time under a clear sky. Below the horizon there is no sun: its
// illuminance is 0.
Sun readSun(const JsonPlace& j);

// Direction towards a sun of that position; `northDeg` is the compass bearing of the scene's -z axis.
Vec3 towardsSun(const SunPosition& position, double northDeg);

// Even luminance, or a picture, which a relative path seeks in `folder`.
Sky readSky(const JsonPlace& j, const std::filesystem::path& folder);

}  // namespace roomlight
