// A scene in a folder or in a zip file among the files that belong to it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "import/import.h"

namespace roomlight::importers {

struct PackedFile {
  std::string name;  // '/' between folders
  uintmax_t bytes = 0;
};

// Which of the files is the scene: by the order of kinds (SceneKind), then nearest to the top, then four times as large
// as the next. Variants of one name beside or below each other (a .glb beside its .gltf) are one scene. Throws Failure
// where there is none, or where it names those that are equally likely.
std::string pickScene(const std::vector<PackedFile>& files);

// Opens a file by the reader of its kind (import.cpp).
Result<Imported> importFile(const std::filesystem::path& file, const ImportOptions& options);

// Opens the scene of a folder, or of a zip file, which is unpacked for as long as it is read. The error is one line
// that names `folder` or `file`.
Result<Imported> importFolder(const std::filesystem::path& folder, const ImportOptions& options);
Result<Imported> importZip(const std::filesystem::path& file, const ImportOptions& options);

}  // namespace roomlight::importers
