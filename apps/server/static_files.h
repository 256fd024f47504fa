// The page's files, read once into memory: what is not among them is not served.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "base/result.h"

namespace roomlight::server {

struct StaticFile {
  std::string bytes;
  std::string type;  // media type
};

// By path from the root, "/index.html"; "/" is the same page.
using StaticFiles = std::map<std::string, StaticFile>;

// All regular files below the folder of kinds that a page has; links are not followed. Errors: there is no index.html,
// or more than 64 MiB.
Result<StaticFiles> readStaticFiles(const std::filesystem::path& folder);

}  // namespace roomlight::server
