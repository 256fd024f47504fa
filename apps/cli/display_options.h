// How pictures in cd/m² are shown, as options of commands say it (docs/reference/conventions.md, exposure and display).
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "base/image_io.h"
#include "base/result.h"
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

}  // namespace roomlight::cli
