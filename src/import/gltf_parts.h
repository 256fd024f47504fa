// What of a glTF file goes into the scene: materials, meshes, nodes, and the lights and cameras at nodes.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "import/gltf_document.h"
#include "scene/scene.h"

namespace roomlight::importers {

// Appends all materials of the file, metallic-roughness with its extensions, in its order, and the textures they use.
// Throws Failure.
void addGltfMaterials(GltfDocument& document, Scene& scene);

// Appends the meshes, one for each primitive, and returns, for each mesh of the file, the indices of its primitives in
// the scene. Primitives without triangles are left out. Needs the materials; adds a grey one where a primitive has
// none. Throws Failure, also where all meshes together have more than `maxTriangles`.
std::vector<std::vector<int>> addGltfMeshes(GltfDocument& document, size_t maxTriangles, Scene& scene);

// Appends instances, lamps, suns and cameras of the default scene (the first where none is named; all nodes where there
// is no scene). `primitivesOfMesh` is what addGltfMeshes returned. Throws Failure, also where nodes form no tree or
// where all instances together have more than `maxTriangles`.
void addGltfNodes(GltfDocument& document, const std::vector<std::vector<int>>& primitivesOfMesh, size_t maxTriangles,
                  Scene& scene);

// Cameras, KHR_lights_punctual lights and photometric luminaires of a glTF file.

// `nodeName` stands in where the thing has no name of its own. Both throw Failure. None: a camera that sees nothing.
std::optional<Camera> readGltfCamera(const Json& camera, const std::string& nodeName, const Affine& world);
// `extension` is that of the node; adds a lamp, or a sun for a directional light.
void addGltfLight(GltfDocument& document, const Json& extension, const std::string& nodeName, const Affine& world,
                  Scene& scene);
// Where the node's extras hold {"roomlight": {"ies": file, ..}}, or its name is that of a photometric file beside the
// scene: nadir along its -z, C0 along its +y.
void addGltfLuminaire(GltfDocument& document, const Json& node, const Affine& world, Scene& scene);

}  // namespace roomlight::importers
