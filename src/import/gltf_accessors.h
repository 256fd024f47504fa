// Values of glTF accessors: any component type, normalized or not, strided, sparse, or all zero where there is no view.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "import/gltf_document.h"

namespace roomlight::importers {

// An accessor whose data were checked to lie within its buffer view.
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

}  // namespace roomlight::importers
