// Sun and sky of a lighting file (docs/reference/lighting.md), apart or as its `daylight`. What is wrong is told to the
// place; see json/json_reader.h.
#pragma once

#include <filesystem>
#include <optional>

#include "json/json_reader.h"
#include "photometry/epw.h"
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

struct Daylight {
  Sun sun;  // black where clouds hide it or it is below the horizon
  Sky sky;  // black at night
};

// The weather file that the place names, from `folder` on; none: the place was told what is wrong.
std::optional<Epw> readWeather(const JsonPlace& j, const std::filesystem::path& folder);

// By the sky's kind, or by measured irradiance and Perez's all-weather sky. `weather`: what its file holds, where that
// was read before; null: it is read.
Daylight readDaylight(const JsonPlace& j, const std::filesystem::path& folder, const Epw* weather = nullptr);

}  // namespace roomlight
