// COLLADA (.dae) and 3D Studio (.3ds) by the library assimp, the only place that knows it.
#pragma once

#include <span>
#include <string>

#include "import/file_access.h"
#include "import/warnings.h"
#include "scene/scene.h"

namespace roomlight::importers {

enum class AssimpFormat {
  Collada,
  Studio3D,
};

// The model in its own unit, y up. It is read in a process of its own, as the library follows cycles and sizes that a hostile file claims,
// and sees no file but these bytes; pictures are read by `companions`, in this process. Throws Failure.
Scene readByAssimp(std::span<const uint8_t> bytes, AssimpFormat format, const ReadCompanion& companions, size_t maxTriangles, Warnings& warnings);

}  // namespace roomlight::importers
