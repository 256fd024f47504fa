// Options of commands that say from where a home is shown, and how pictures in cd/m² are shown
// (docs/reference/conventions.md, exposure and display).
#pragma once

#include <CLI/CLI.hpp>

#include <optional>
#include <string>

#include "base/result.h"
#include "engine/views.h"
#include "look/display.h"

namespace roomlight::cli {

struct DisplayOptions {
  std::string look = "natural", exposure = "auto", tone, whiteBalance;  // empty: the look's
  std::optional<float> contrast, saturation, localExposure, glare, vignette;
  bool operator==(const DisplayOptions&) const = default;
};

void addDisplayOptions(CLI::App& command, DisplayOptions& options, const std::string& ofWhat);
Result<Display> readDisplay(const DisplayOptions& options);

// Options that say from where a home is shown.
struct ViewOptions {
  std::string view = "camera", level, room, eye, target, backdrop;
  std::optional<float> cutM, metresPerPixel, fovDeg;
};

void addViewOptions(CLI::App& app, ViewOptions& options);

// Everything that can be known to be wrong without the scene. `cameraNamed`: with --camera.
Result<ViewWish> readViewWish(const ViewOptions& options, bool cameraNamed);

}  // namespace roomlight::cli
