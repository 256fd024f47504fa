// Files that are there whole or not at all, and folders that one program at a time writes into.
#pragma once

#include <filesystem>
#include <memory>
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

// A folder that one program at a time writes into, held as long as a copy lives.
using HeldFolder = std::shared_ptr<const void>;

// Makes the folder where it is not there and holds it, against others in this process too; null where it is held
// already. When it is let go, folders that were made for it and are still empty are removed. The error names the folder
// and the system's reason.
Result<HeldFolder> holdFolder(const std::filesystem::path& folder);

}  // namespace roomlight
