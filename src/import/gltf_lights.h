// Cameras, KHR_lights_punctual lights and photometric luminaires of a glTF file.
#pragma once

#include <optional>
#include <string>

#include "import/gltf_document.h"
#include "scene/scene.h"

namespace roomlight::importers {

// `nodeName` stands in where the thing has no name of its own. Both throw Failure. None: a camera that sees nothing.
std::optional<Camera> readGltfCamera(const Json& camera, const std::string& nodeName, const Affine& world);
// `extension` is that of the node; adds a lamp, or a sun for a directional light.
void addGltfLight(GltfDocument& document, const Json& extension, const std::string& nodeName, const Affine& world,
                  Scene& scene);
// Where the node's extras hold {"roomlight": {"ies": file, ..}}, or its name is that of a photometric file beside the
// scene: nadir along its -z, C0 along its +y.
void addGltfLuminaire(GltfDocument& document, const Json& node, const Affine& world, Scene& scene);

}  // namespace roomlight::importers
