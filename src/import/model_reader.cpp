#include "import/model_reader.h"

#include <fmt/format.h>

#include <assimp/config.h>
#include <assimp/importerdesc.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <assimp/IOStream.hpp>
#include <assimp/IOSystem.hpp>
#include <assimp/Importer.hpp>

#include <algorithm>
#include <charconv>
#include <cstring>
#include <span>
#include <string_view>

#include "import/child_process.h"
#include "import/failure.h"

namespace roomlight::importers {
namespace {

class MemoryStream : public Assimp::IOStream {
 public:
  explicit MemoryStream(std::span<const uint8_t> bytes) : bytes_(bytes) {}
  size_t Read(void* to, size_t size, size_t count) override {
    if (size == 0) return 0;
    const size_t whole = std::min(count, (bytes_.size() - at_) / size);
    if (whole > 0) std::memcpy(to, bytes_.data() + at_, whole * size);
    at_ += whole * size;
    return whole;
  }
  size_t Write(const void*, size_t, size_t) override { return 0; }
  aiReturn Seek(size_t offset, aiOrigin origin) override {
    const size_t base = origin == aiOrigin_SET ? 0 : origin == aiOrigin_CUR ? at_ : bytes_.size();
    const size_t to = base + offset;  // backwards wraps around
    if (to > bytes_.size()) return aiReturn_FAILURE;
    at_ = to;
    return aiReturn_SUCCESS;
  }
  size_t Tell() const override { return at_; }
  size_t FileSize() const override { return bytes_.size(); }
  void Flush() override {}

 private:
  std::span<const uint8_t> bytes_;
  size_t at_ = 0;
};

// A disk with one file.
class OneFile : public Assimp::IOSystem {
 public:
  OneFile(std::string name, std::span<const uint8_t> bytes) : name_(std::move(name)), bytes_(bytes) {}
  bool Exists(const char* name) const override { return name == name_; }
  char getOsSeparator() const override { return '/'; }
  Assimp::IOStream* Open(const char* name, const char*) override {
    return name == name_ ? new MemoryStream(bytes_) : nullptr;
  }
  void Close(Assimp::IOStream* stream) override { delete stream; }

 private:
  std::string name_;
  std::span<const uint8_t> bytes_;
};

// Of the library's forty formats only the one that is meant.
void keepOnly(Assimp::Importer& importer, const std::string& extension) {
  for (size_t i = importer.GetImporterCount(); i-- > 0;) {
    const aiImporterDesc* about = importer.GetImporterInfo(i);
    const std::string extensions = about && about->mFileExtensions ? fmt::format(" {} ", about->mFileExtensions) : "";
    if (extensions.find(" " + extension + " ") == std::string::npos) importer.UnregisterLoader(importer.GetImporter(i));
  }
}

Bytes readInside(std::span<const uint8_t> bytes, AssimpFormat format, bool ignoreUp, size_t maxTriangles) {
  Assimp::Importer importer;
  const std::string extension = extensionOf(format);
  keepOnly(importer, extension);
  const std::string name = "model." + extension;
  importer.SetIOHandler(new OneFile(name, bytes));  // owned by the importer
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_USE_COLLADA_NAMES, true);  // of nodes, instead of their ids
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, ignoreUp);
  importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_PRESERVE_PIVOTS,
                           false);  // one node for each of the file's, not one for each part of its transform
  importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_READ_ANIMATIONS, false);
  unsigned steps = aiProcess_Triangulate | aiProcess_JoinIdenticalVertices | aiProcess_TransformUVCoords;
  if (format == AssimpFormat::Stl) {
    // Normals of facets, often wrong, which would keep their corners apart.
    importer.SetPropertyInteger(AI_CONFIG_PP_RVC_FLAGS, aiComponent_NORMALS);
    steps |= aiProcess_RemoveComponent;
  }
  const aiScene* scene = importer.ReadFile(name, steps);
  if (!scene) fail("", std::string("is damaged, or of a version that is not read: ") + importer.GetErrorString());
  return toBytes(collectForeign(*scene, format, maxTriangles));
}

struct Task {
  AssimpFormat format = AssimpFormat::Ply;
  bool ignoreUp = false;
  size_t maxTriangles = 0;
};

Task taskOf(std::span<const std::string_view> words) {
  Task task;
  bool known = words.size() == 3 && (words[1] == "stated" || words[1] == "own");
  const auto format = std::find(kAssimpExtensions.begin(), kAssimpExtensions.end(), known ? words[0] : "");
  known = known && format != kAssimpExtensions.end();
  if (known) {
    task.format = static_cast<AssimpFormat>(format - kAssimpExtensions.begin());
    task.ignoreUp = words[1] == "own";
    const auto [end, code] = std::from_chars(words[2].data(), words[2].data() + words[2].size(), task.maxTriangles);
    known = code == std::errc() && end == words[2].data() + words[2].size();
  }
  if (!known) fail("", "roomlight reads models by this program: dae|3ds|fbx|stl|ply stated|own TRIANGLES < FILE");
  return task;
}

}  // namespace

void modelReaderMain(int argc, char** argv) {
  serveParent([&](const Bytes& input) {
    const std::vector<std::string_view> words(argv + std::min(argc, 1), argv + argc);
    const Task task = taskOf(words);
    return readInside(input, task.format, task.ignoreUp, task.maxTriangles);
  });
}

}  // namespace roomlight::importers
