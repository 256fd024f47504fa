// Builds small glTF files for tests: JSON that a test may bend, and the bytes that it refers to.
#pragma once

#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/result.h"
#include "import/import.h"

namespace roomlight::testing {

class GltfFile {
 public:
  nlohmann::json json;
  std::string bytes;  // the binary chunk, buffer 0

  // A node with a mesh of one triangle (0,0,0) (1,0,0) (0,1,0): accessor 0 its positions, accessor 1 its indices.
  static GltfFile triangle();

  // Appends and returns the index of the new view or accessor.
  int addView(const std::string& data);
  template <class T>
  int addAccessor(const std::vector<T>& numbers, int componentType, const std::string& type, bool normalized = false) {
    std::string data(numbers.size() * sizeof(T), '\0');
    std::memcpy(data.data(), numbers.data(), data.size());
    const size_t width = type == "SCALAR" ? 1 : static_cast<size_t>(type.back() - '0');
    json["accessors"].push_back({{"bufferView", addView(data)},
                                 {"componentType", componentType},
                                 {"count", numbers.size() / width},
                                 {"type", type}});
    if (normalized) json["accessors"].back()["normalized"] = true;
    return static_cast<int>(json["accessors"].size()) - 1;
  }
  int addFloats(const std::vector<float>& numbers, const std::string& type) { return addAccessor(numbers, 5126, type); }

  nlohmann::json& primitive() { return json["meshes"][0]["primitives"][0]; }
  nlohmann::json& node() { return json["nodes"][0]; }

  std::string glb() const;  // the whole file; buffer 0's length is filled in
  Result<Imported> import(const std::filesystem::path& file,
                          const ImportOptions& options = {}) const;  // writes .glb, then reads
};

// A picture of one colour.
std::string pngOf(int width, int height, float grey);

}  // namespace roomlight::testing
