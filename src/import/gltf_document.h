// A glTF file opened: container and JSON checked, its extensions known, buffers loaded and decompressed.
#pragma once

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <span>
#include <vector>

#include "import/file_access.h"
#include "import/gltf_json.h"
#include "import/photometric_file.h"
#include "import/warnings.h"

namespace roomlight::importers {

struct BufferView {
  std::span<const uint8_t> bytes;
  size_t stride = 0;  // 0: elements lie back to back
};

// How many vertices, indices and placements a file may still unfold into, so that a small file cannot fill the memory.
class ElementBudget {
 public:
  void grantFor(size_t fileBytes);  // what so many bytes of a file may unfold into
  size_t left() const { return left_; }
  void spend(size_t elements, const std::string& place);  // throws Failure

 private:
  size_t left_ = size_t{1} << 22;  // even the smallest file may
};

struct GltfDocument {
  std::filesystem::path folder;
  Bytes file;
  nlohmann::json json;
  std::span<const uint8_t> binaryChunk;
  std::vector<Bytes> storage;  // of buffers and decompressed buffer views
  std::vector<BufferView> views;
  ElementBudget budget;
  Warnings warnings;
  PhotometricFiles photometric;

  Json root() const { return Json(json, ""); }

  // Index into a list of `count` things that the file can do without; -1: none, or one that does not exist, which is
// counted.
  int looseIndex(const Json& in, const char* key, size_t count) {
    bool isBroken = false;
    const int index = in.looseIndex(key, count, isBroken);
    if (isBroken) warnings.add("references to things that do not exist are ignored");
    return index;
  }
};

// Throws Failure. Refuses versions other than 2 and required extensions without which the file would show wrong; warns
// of used ones that are not honoured. Spans point into the document: it stays where it is.
std::unique_ptr<GltfDocument> openGltf(const std::filesystem::path& file);

// The steps of openGltf.
void parseContainer(GltfDocument& document);  // file -> json, binaryChunk
void checkExtensions(GltfDocument& document);
void loadBuffers(GltfDocument& document);     // -> storage, views

// EXT_meshopt_compression: the bytes of a compressed view. `extension` is the extension's object in the buffer view.
Bytes decodeMeshopt(std::span<const uint8_t> compressed, const Json& extension);

}  // namespace roomlight::importers
