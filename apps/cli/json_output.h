// What commands write as JSON.
#pragma once

#include <span>

#include <nlohmann/json.hpp>

#include "engine/render.h"

namespace roomlight::cli {

using Json = nlohmann::ordered_json;

// Time and memory of each stage.
Json stagesJson(std::span<const StageStats> stages);

}  // namespace roomlight::cli
