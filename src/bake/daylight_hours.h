// Sun and sky of a home at other hours of its day.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "base/result.h"
#include "scene/scene.h"

namespace roomlight::bake {

struct DaylightHour {
  double hour = 12;  // local time
  std::vector<Sun> suns;
  Sky sky;
};

// The local hour of a `daylight` (docs/reference/lighting.md); none where it has no time.
std::optional<double> hourOf(const nlohmann::json& daylight);

// The same `daylight`, place, date and sky at an hour of that day, 0 to 24. Paths in it are relative to `folder`.
// Errors: it has no time; what is wrong with it.
Result<DaylightHour> daylightAt(const nlohmann::json& daylight, const std::filesystem::path& folder, double hour);

}  // namespace roomlight::bake
