// From files to a home that a session can open.
#pragma once

#include <filesystem>

#include "import/import.h"
#include "view/home.h"

namespace roomlight::view {

// `lighting` may be empty.
Result<ViewHome> openHome(const std::filesystem::path& scene, const std::filesystem::path& lighting, const ImportOptions& options, std::vector<std::string>& warnings);

}  // namespace roomlight::view
