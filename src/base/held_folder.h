// A folder that one program at a time writes into.
#pragma once

#include <filesystem>
#include <memory>

#include "base/result.h"

namespace roomlight {

// Held as long as a copy lives.
using HeldFolder = std::shared_ptr<const void>;

// Makes the folder where it is not there and holds it, against others in this process too; null where it is held
// already. When it is let go, folders that were made for it and are still empty are removed. The error names the folder
// and the system's reason.
Result<HeldFolder> holdFolder(const std::filesystem::path& folder);

}  // namespace roomlight
