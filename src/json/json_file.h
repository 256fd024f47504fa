// A hand-written JSON file as a document, with bounds on what a hostile one can cost.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string_view>

#include "base/result.h"

namespace roomlight {

// At most 16 MiB, nested at most 32 deep, every key once in its object; comments (// and /* */) are allowed.
Result<nlohmann::json> readJsonFile(const std::filesystem::path& file);
// The same bounds on a text, but for its size; no comments. The error names no place.
Result<nlohmann::json> parseJson(std::string_view text);

}  // namespace roomlight
