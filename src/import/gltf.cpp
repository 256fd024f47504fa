// glTF 2.0, JSON and binary (Khronos specification 2.0.1): docs/reference/import.md says what is honoured.
#include "import/gltf_document.h"
#include "import/gltf_parts.h"
#include "import/guarded.h"
#include "import/import.h"

namespace roomlight {

Result<Imported> importGltf(const std::filesystem::path& file, const ImportOptions& options) {
  return importers::guarded(file, [&] {
    Imported imported;
    const auto document = importers::openGltf(file);
    importers::addGltfMaterials(*document, imported.scene);
    const auto primitivesOfMesh = importers::addGltfMeshes(*document, options.maxTriangles, imported.scene);
    importers::addGltfNodes(*document, primitivesOfMesh, options.maxTriangles, imported.scene);
    imported.warnings = document->warnings.lines();
    const auto& odd = document->photometric.warnings();
    imported.warnings.insert(imported.warnings.end(), odd.begin(), odd.end());
    imported.faults = document->warnings.faults().lines(), imported.faultCount = document->warnings.faults().total();
    return imported;
  });
}

}  // namespace roomlight
