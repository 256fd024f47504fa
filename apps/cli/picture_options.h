// Options of commands that say from where a home is shown, and how pictures in cd/m² are shown
// (docs/reference/conventions.md, exposure and display).
#pragma once

#include <CLI/CLI.hpp>

#include <optional>
#include <string>

#include "base/image_io.h"
#include "base/result.h"
#include "base/vec.h"
#include "engine/views.h"
#include "look/display.h"

namespace roomlight::cli {

// Metadata of linear pictures: what to balance them by, linear Rec.709.
constexpr const char* kLightColourKey = "roomlight.lightColour";

struct DisplayOptions {
  std::string look = "natural", exposure = "auto", tone, whiteBalance;  // empty: the look's
  std::optional<float> contrast, saturation, localExposure, glare, vignette;
  bool operator==(const DisplayOptions&) const = default;
};

void addDisplayOptions(CLI::App& command, DisplayOptions& options, const std::string& ofWhat);
Result<Display> readDisplay(const DisplayOptions& options);

// Of the light in a picture, as render wrote it; none: it does not say.
std::optional<Vec3> lightColourIn(const Metadata& metadata);

// Options that say from where a home is shown.
struct ViewOptions {
  std::string view = "camera", level, room, eye, target, backdrop;
  std::optional<float> cutM, metresPerPixel, fovDeg;
};

void addViewOptions(CLI::App& app, ViewOptions& options);

// Everything that can be known to be wrong without the scene. `cameraNamed`: with --camera.
Result<ViewWish> readViewWish(const ViewOptions& options, bool cameraNamed);

// How parts of plans look that are no light, encoded in sRGB.
inline constexpr Vec3 kSectionColour{0.2f, 0.2f, 0.22f}, kPaperColour{1, 1, 1};

}  // namespace roomlight::cli
