// Any bytes as files of models and scenes: a scene or one line of error.
#include <algorithm>
#include <cstdlib>
#include <cstring>

#include "fuzz/fuzz_support.h"
#include "import/failure.h"
#include "import/file_access.h"
#include "import/foreign_model.h"
#include "import/import.h"
#include "import/pictures.h"
#include "import/scene_kind.h"
#include "import/scene_package.h"
#include "import/up_axis.h"
#include "scene/validate.h"
#include "unit/temporary_folder.h"

namespace roomlight::fuzz {
namespace {

std::string word(size_t v) {
  const auto u = static_cast<uint32_t>(v);
  return {reinterpret_cast<const char*>(&u), 4};
}

std::string asBinary(const std::string& input) {
  if (input.starts_with("glTF")) return input;
  const size_t end = std::min(input.find('\0'), input.size());
  const std::string json = input.substr(0, end), chunk = input.substr(std::min(end + 1, input.size()));
  return "glTF" + word(2) + word(28 + json.size() + chunk.size()) + word(json.size()) + "JSON" + json +
         word(chunk.size()) + std::string("BIN\0", 4) + chunk;
}

}  // namespace

// Any bytes as a glTF file: a scene or one line of error. Bytes that are no binary glTF are taken as JSON, a zero byte,
// and the binary chunk, so that the fuzzer need not keep the lengths of a container right.
void gltf(const uint8_t* data, size_t size) {
  static const testing::TemporaryFolder folder;
  testing::writeFile(folder / "a.glb", asBinary({reinterpret_cast<const char*>(data), size}));
  const auto imported = importScene(folder / "a.glb", {.maxTriangles = 1 << 20});
  if (!imported && (imported.error().empty() || imported.error().find('\n') != std::string::npos)) std::abort();
}

// Any bytes as a KTX2 picture, its magic number left out: texels as many as it claims, or one line of error.
void ktx2(const uint8_t* data, size_t size) {
  using namespace importers;
  Bytes bytes = {0xab, 'K', 'T', 'X', ' ', '2', '0', 0xbb, '\r', '\n', 0x1a, '\n'};
  bytes.insert(bytes.end(), data, data + size);
  if (claimedPixels(bytes) > (1 << 20)) return;  // honest, but slow to fill
  Warnings warnings;
  const DecodedPicture picture = tryPictures({{"picture", bytes}}, warnings)[0];
  const auto& t = picture.texture;
  if (picture.failure.empty())
    require(t.width > 0 && t.height > 0 &&
            t.rgba.size() == 4 * static_cast<size_t>(t.width) * static_cast<size_t>(t.height));
  require(picture.failure.find('\n') == std::string::npos);
}

// Any bytes as an OBJ file; those after a zero byte are the MTL file a.mtl beside it.
void obj(const uint8_t* data, size_t size) {
  static const testing::TemporaryFolder folder;
  const uint8_t* end = std::find(data, data + size, uint8_t{0});
  testing::writeFile(folder / "a.obj", {data, end});
  testing::writeFile(folder / "a.mtl", {end == data + size ? end : end + 1, data + size});
  const auto imported = importScene(folder / "a.obj", {.maxTriangles = 1 << 20});
  if (!imported && (imported.error().empty() || imported.error().find('\n') != std::string::npos)) std::abort();
}

// Any bytes as what a reader's process sends back: nothing in them is believed. A model that is taken is one that all
// stages can read.
void foreign_model(const uint8_t* data, size_t size) {
  using namespace importers;
  try {
    ForeignModel model = foreignModel(Bytes(data, data + size));
    const std::vector<ForeignLight> lights = model.lights;
    Warnings warnings;
    Scene scene = sceneOf(
        std::move(model), [](std::string_view, const std::string&) { return std::optional<Bytes>(); }, warnings);
    addForeignLights(lights, 1, scene, warnings);
    standUpright(scene, std::nullopt, 1, UpAxis::Z, warnings);
    (void)validate(scene);
  } catch (const Failure&) {}
}

// Any bytes as a zip file with a scene, and as the names of a folder's files, one a line.
void scene_package(const uint8_t* data, size_t size) {
  static const testing::TemporaryFolder folder;
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  testing::writeFile(folder / "a.zip", bytes);
  const Result<Imported> imported = importers::importZip(folder / "a.zip", {.maxTriangles = 1 << 20});
  require(imported || (!imported.error().empty() && imported.error().find('\n') == std::string::npos));
  std::vector<importers::PackedFile> files;
  std::vector<std::string> names;
  for (size_t at = 0; at < bytes.size();) {
    const size_t end = std::min(bytes.find('\n', at), bytes.size());
    names.push_back(bytes.substr(at, end - at)), files.push_back({names.back(), end});
    at = end + 1;
  }
  (void)importers::kindByContent(bytes, size);
  if (!names.empty()) (void)importers::meantName(names, "a/", names.back());
  try {
    (void)importers::pickScene(files);
  } catch (const importers::Failure&) {}
}

}  // namespace roomlight::fuzz
