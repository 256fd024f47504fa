// Finds the files that a scene names as its exporter's machine knew them: absolute paths of other disks, backslashes,
 // wrong case, another folder.
#pragma once

#include "import/file_access.h"

namespace roomlight::importers {

// Of the names (relative, '/' between folders) the one that a reference means, seen from `folder` ("" or "a/b/"); none
// where no name ends like it. First the very place, then names with the same last part, of which the one that shares
// most folders with the reference from its end, then the one nearest to the top. Case does not count; a picture may
// have become PNG, JPEG or WebP.
std::optional<std::string> meantName(const std::vector<std::string>& names, std::string_view folder,
                                     std::string_view reference);

// Of a scene file: files below `root` (empty: below its own folder) are found, none elsewhere. The folder is looked
// through only when a reference is not where it says, some folders deep and some thousand files at most.
ReadCompanion companionsAround(const std::filesystem::path& sceneFile, const std::filesystem::path& root);

// Paths of the files below a folder, relative to it; without hidden ones and linked folders. None where there are more
// than `most`.
std::optional<std::vector<std::string>> filesBelow(const std::filesystem::path& folder, size_t most, int deepest);

}  // namespace roomlight::importers
