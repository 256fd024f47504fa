// Files that a run keeps for the next one, and that tell whether they are as they were written.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "base/result.h"

namespace roomlight {

// Of a regular file; none where there is none to read.
std::optional<std::string> contentOf(const std::filesystem::path& file);

// Adds what loadSealed() tells by whether the bytes are as they were.
void seal(std::string& bytes);

// Whole or not at all, sealed.
Status saveSealed(const std::filesystem::path& file, std::string bytes);

// What was saved; none where there is no file. The error is of a file that is not as it was written.
Result<std::optional<std::string>> loadSealed(const std::filesystem::path& file);

}  // namespace roomlight
