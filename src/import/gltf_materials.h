// Materials of a glTF file: metallic-roughness with its extensions.
#pragma once

#include "import/gltf_document.h"
#include "scene/scene.h"

namespace roomlight::importers {

// Appends all materials of the file, in its order, and the textures they use. Throws Failure.
void addGltfMaterials(GltfDocument& document, Scene& scene);

}  // namespace roomlight::importers
