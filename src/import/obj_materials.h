// Materials of MTL files.
#pragma once

#include <string>
#include <vector>

#include "import/file_access.h"
#include "import/warnings.h"
#include "scene/scene.h"

namespace roomlight::importers {

// Reads the libraries and appends one material for each name to the scene, in the order of the names. A library that
// is missing and a name that no library holds are warnings; the latter becomes a grey diffuse material, as does the
// name "". Throws Failure.
void addObjMaterials(const ReadCompanion& companions, const std::vector<std::string>& libraries,
                     const std::vector<std::string>& names, Scene& scene, Warnings& warnings);

}  // namespace roomlight::importers
