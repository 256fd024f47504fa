// KHR_draco_mesh_compression: the triangles and vertices of one primitive packed by Draco.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "import/gltf_document.h"

namespace roomlight::importers {

struct DracoAttribute {
  int components = 0;
  bool scaled = false;  // normalized integers are already divided
  std::vector<float> values;
};

struct DracoPrimitive {
  size_t vertexCount = 0;
  std::vector<uint32_t> indices;
  std::map<std::string, DracoAttribute> attributes;  // by their glTF name
};

// `extension` is the extension's object in the primitive. Throws Failure where the data are damaged or claim more than
// their bytes or the document's budget allow; checked before memory is taken.
DracoPrimitive decodeDraco(GltfDocument& document, const Json& extension);

}  // namespace roomlight::importers
