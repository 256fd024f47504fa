// Which reader a file is for: by its extension, and by its content where that is beyond doubt.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "import/file_access.h"

namespace roomlight::importers {

// In the order in which one of several files of a folder is preferred.
enum class SceneKind {
  Gltf,
  Sh3d,
  Obj,
  Fbx,
  Collada,
  Studio3D,
  Ply,
  Stl,
  Sh3f,
  Zip,
};

// ".glb" and so on, with the dot, in lower case; none where no reader is for it.
std::optional<SceneKind> kindByExtension(const std::filesystem::path& file);

// What the bytes say that a file begins with, `size` being its own; none where they fit several kinds or none.
std::optional<SceneKind> kindByContent(std::string_view beginning, uintmax_t size);

// Of a file on disk: its content where that is beyond doubt, otherwise its extension. Throws Failure that says what is
// wrong and what to do.
SceneKind kindOf(const std::filesystem::path& file);

// What to do with a file of a program's own format (".blend", ".skp", ...); empty for any other.
std::string adviceFor(const std::filesystem::path& file);

}  // namespace roomlight::importers
