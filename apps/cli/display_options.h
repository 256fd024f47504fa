// How pictures in cd/m² are shown, as options of commands say it: --exposure, --tone, --white-balance (docs/conventions.md, exposure and display).
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "base/result.h"
#include "engine/display.h"

namespace roomlight::cli {

struct DisplayOptions {
  std::string exposure = "auto", tone = "neutral", whiteBalance = "auto";
};

void addDisplayOptions(CLI::App& command, DisplayOptions& options, const std::string& ofWhat);
Result<Display> readDisplay(const DisplayOptions& options);

}  // namespace roomlight::cli
