// FBX, COLLADA (.dae), 3D Studio (.3ds), STL and PLY by the library assimp: files as scenes, and single models.
#pragma once

#include <array>
#include <span>

#include "import/file_access.h"
#include "import/foreign_model.h"
#include "import/import.h"
#include "import/up_axis.h"
#include "import/warnings.h"
#include "scene/scene.h"

namespace roomlight::importers {

enum class AssimpFormat {
  Collada,
  Studio3D,
  Fbx,
  Stl,
  Ply,
};

// Their usual extensions, which also stand for them in the arguments of the reader's program.
inline constexpr std::array<const char*, 5> kAssimpExtensions = {"dae", "3ds", "fbx", "stl", "ply"};
inline const char* extensionOf(AssimpFormat format) { return kAssimpExtensions[static_cast<size_t>(format)]; }

// What a file of the format means that does not say which axis points up.
UpAxis usualUp(AssimpFormat format);

// The file is read by a program of its own (model_reader.h). `ignoreUp`: in the file's own axes even where it says
// which one points up. All instances together have at most `maxTriangles`, and three times as many vertices. Throws
// Failure.
ForeignModel readForeign(std::span<const uint8_t> bytes, AssimpFormat format, bool ignoreUp, size_t maxTriangles);

// One model of many: in its own unit, y up, without transforms, lights and cameras; pictures are read by `companions`,
// in this process.
Scene readByAssimp(std::span<const uint8_t> bytes, AssimpFormat format, const ReadCompanion& companions,
                   size_t maxTriangles, Warnings& warnings);

// A file as a scene; same contract as importGltf (import.h).
Result<Imported> importForeign(const std::filesystem::path& file, AssimpFormat format, const ImportOptions& options);

}  // namespace roomlight::importers
