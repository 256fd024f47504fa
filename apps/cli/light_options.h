// Options of commands that share the light of a home with other processes, and light it for more cameras than they take
// pictures of.
#pragma once

#include <CLI/CLI.hpp>

#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "engine/light_store.h"
#include "engine/settings.h"

namespace roomlight::cli {

struct LightOptions {
  std::vector<std::string> lightFor;  // cameras; none: those of the pictures
  std::string folder;  // empty: light is not shared
  std::optional<std::string> size;
};

void addLightOptions(CLI::App& app, LightOptions& options);

// Everything that can be known to be wrong without the scene. None: light is not shared, and stderr says why where that
// was asked for.
Result<std::optional<LightStore>> readLightStore(const LightOptions& options, const RenderSettings& settings);

}  // namespace roomlight::cli
