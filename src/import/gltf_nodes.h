// The nodes of a glTF file's scene: what stands, shines and looks where.
#pragma once

#include <vector>

#include "import/gltf_document.h"
#include "scene/scene.h"

namespace roomlight::importers {

// Appends instances, lamps, suns and cameras of the default scene (the first where none is named; all nodes where there
// is no scene). `primitivesOfMesh` is what addGltfMeshes returned. Throws Failure, also where nodes form no tree or
// where all instances together have more than `maxTriangles`.
void addGltfNodes(GltfDocument& document, const std::vector<std::vector<int>>& primitivesOfMesh, size_t maxTriangles,
                  Scene& scene);

}  // namespace roomlight::importers
