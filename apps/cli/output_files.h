// Files the program writes: checked before the work.
#pragma once

#include <filesystem>
#include <string>

#include "base/result.h"

namespace roomlight::cli {

// Could this file be written? Leaves no trace.
Status checkWritable(const std::filesystem::path& file);

Result<std::string> readTextFile(const std::filesystem::path& file);

}  // namespace roomlight::cli
