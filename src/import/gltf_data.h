// The numbers in the buffers of a glTF file: accessors, and primitives packed by Draco.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "import/gltf_document.h"

namespace roomlight::importers {

// Values of glTF accessors: any component type, normalized or not, strided, sparse, or all zero where there is no view.
// An accessor's data were checked to lie within its buffer view.
struct Accessor {
  Json json;  // for messages
  size_t count = 0;
  int components = 1;  // 1 to 4
  int componentType = 0;  // 5120 ... 5126
  bool normalized = false;
  std::span<const uint8_t> bytes;  // empty: zeros
  size_t stride = 0;
  std::vector<uint32_t> sparseIndices;  // ascending
  std::span<const uint8_t> sparseBytes;  // back to back
};

// The accessor that the JSON number `use` names; its sparse indices count as elements that the file unfolds into.
// Throws Failure.
Accessor openAccessor(GltfDocument& document, const Json& use);

// `components` numbers an element, of all elements or of those in `selection`; floats as they are, finite or not. An
// accessor with more components gives the first ones; with fewer it is refused.
std::vector<float> readFloats(const Accessor& accessor, int components, std::span<const uint32_t> selection = {});

// Whole numbers of one component; negative ones, which some exporters' types allow, become the largest.
std::vector<uint32_t> readIndices(const Accessor& accessor);

// What a normalized integer of this component type is divided by; 1 for floats and 32-bit numbers.
float normalizer(int componentType);

// KHR_draco_mesh_compression: the triangles and vertices of one primitive packed by Draco.
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
