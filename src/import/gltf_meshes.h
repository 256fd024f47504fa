// Meshes of a glTF file, one of the scene's for each primitive.
#pragma once

#include <vector>

#include "import/gltf_document.h"
#include "scene/scene.h"

namespace roomlight::importers {

// Appends the meshes and returns, for each mesh of the file, the indices of its primitives in the scene. Primitives
// without triangles are left out. Needs the materials; adds a grey one where a primitive has none. Throws Failure,
// also where all meshes together have more than `maxTriangles`.
std::vector<std::vector<int>> addGltfMeshes(GltfDocument& document, size_t maxTriangles, Scene& scene);

}  // namespace roomlight::importers
