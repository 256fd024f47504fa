// Files and URIs that a scene file refers to, kept inside the scene file's folder, and looked for there.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace roomlight::importers {

using Bytes = std::vector<uint8_t>;

// The whole file. Throws Failure when it is missing, no regular file, or above 4 GiB.
Bytes readWholeFile(const std::filesystem::path& file, const std::string& place);

// The file that a relative reference names. Throws Failure when the reference has a scheme, is absolute, or leaves
// `folder`, also by way of symbolic links. The file need not exist.
std::filesystem::path pathInside(const std::filesystem::path& folder, std::string_view reference,
                                 const std::string& place);

// The same for a file that exists, also where its name or that of a folder differs by upper and lower case, or has '\\'
// between folders; none where there is none.
std::optional<std::filesystem::path> findInside(const std::filesystem::path& folder, std::string_view reference,
                                                const std::string& place);

// Reads a file that another one names by a relative reference with '/' or '\\' between folders; none where there is no
// such file. Throws Failure where the reference leads out, or the file cannot be read.
using ReadCompanion = std::function<std::optional<Bytes>(std::string_view reference, const std::string& place)>;

// Of a file in `folder`.
ReadCompanion companionsIn(const std::filesystem::path& folder);

// "%20" to " "; what is no escape stays as it is.
std::string percentDecode(std::string_view uri);

// The bytes of a "data:...;base64,..." URI; none for any other URI. Throws Failure on bad base64.
std::optional<Bytes> dataUri(std::string_view uri, const std::string& place);

// The file in `folder` that a glTF URI names, escaped or not; none where there is none. Throws Failure where it leads
// out.
std::optional<std::filesystem::path> fileOfUri(const std::filesystem::path& folder, std::string_view uri,
                                               const std::string& place);

// The bytes that a glTF URI means: a data URI's own, or those of the file it names in `folder`. Throws Failure.
Bytes readUri(const std::filesystem::path& folder, std::string_view uri, const std::string& place);

// A scene may name files as its exporter's machine knew them: by absolute paths of other disks, with backslashes, in
// wrong case, in another folder. The rest finds these (companion_search.cpp).

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
