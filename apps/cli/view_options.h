// Options that say from where a home is shown.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "engine/views.h"

namespace roomlight::cli {

struct ViewOptions {
  std::string view = "camera", level, room, eye, target, backdrop;
  std::optional<float> cutM, metresPerPixel, fovDeg;
};

void addViewOptions(CLI::App& app, ViewOptions& options);

// Everything that can be known to be wrong without the scene. `cameraNamed`: with --camera.
Result<ViewWish> readViewWish(const ViewOptions& options, bool cameraNamed);

}  // namespace roomlight::cli
