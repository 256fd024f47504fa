// What the program writes: files, checked before the work; JSON.
#pragma once

#include <nlohmann/json.hpp>

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "base/result.h"
#include "engine/render.h"

namespace roomlight::cli {

// Could this file be written? Leaves no trace.
Status checkWritable(const std::filesystem::path& file);

// `file` with a name of each of `things` before its extension, such as home_Kitchen.png; of one thing alone the file
// itself. Slashes, blanks and what no file should have become _, and what is there already gets a number.
std::vector<std::string> filesNamedAfter(const std::string& file, const std::vector<std::string>& things);

Result<std::string> readTextFile(const std::filesystem::path& file);

using Json = nlohmann::ordered_json;

// Time and memory of each stage.
Json stagesJson(std::span<const StageStats> stages);

}  // namespace roomlight::cli
