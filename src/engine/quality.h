// Presets of quality: how much is done for a picture before anybody asks for more.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "base/result.h"

namespace roomlight {

struct RenderSettings;

// Names for --quality, each with one line of explanation, the quickest first.
std::vector<std::pair<std::string, std::string>> qualities();

// The starting values of the groups "voxel", "radiance" and "hybrid" and of blendUntilMse. Errors: an unknown name.
Status applyQuality(const std::string& name, RenderSettings& settings);

}  // namespace roomlight
