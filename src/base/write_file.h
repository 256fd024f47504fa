// Files that are there whole or not at all.
#pragma once

#include <filesystem>
#include <string_view>

#include "base/result.h"

namespace roomlight {

// The name of a file that is not finished, beside where it will be.
std::filesystem::path unfinishedName(std::filesystem::path file);

// A reader of `file` sees either the old file or the whole new one: written beside it, then renamed. Errors name the
// file and the system's reason, and leave nothing behind.
Status writeWhole(const std::filesystem::path& file, std::string_view bytes);

// "file: cannot be written: the system's reason".
Error cannotWrite(const std::filesystem::path& file, int errorNumber);

}  // namespace roomlight
