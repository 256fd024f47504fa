// Wavefront OBJ from memory: of a file, or of an archive's entry.
#pragma once

#include <span>

#include "import/file_access.h"
#include "import/warnings.h"
#include "scene/scene.h"

namespace roomlight::importers {

// The scene as the file says it, in its own unit; `companions` reads its MTL files and their pictures. Throws Failure.
Scene readObj(std::span<const uint8_t> bytes, const ReadCompanion& companions, size_t maxTriangles, Warnings& warnings);

}  // namespace roomlight::importers
