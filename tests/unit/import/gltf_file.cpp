#include "unit/import/gltf_file.h"

#include "base/image_io.h"
#include "unit/temporary_folder.h"

namespace roomlight::testing {
namespace {

std::string word(size_t v) {
  std::string s(4, '\0');
  const auto u = static_cast<uint32_t>(v);
  std::memcpy(s.data(), &u, 4);
  return s;
}

}  // namespace

GltfFile GltfFile::triangle() {
  GltfFile f;
  f.json = {{"asset", {{"version", "2.0"}}},          {"scene", 0},
            {"scenes", {{{"nodes", {0}}}}},           {"nodes", {{{"mesh", 0}, {"name", "thing"}}}},
            {"materials", {{{"name", "paint"}}}},     {"accessors", nlohmann::json::array()},
            {"bufferViews", nlohmann::json::array()}, {"buffers", {{{"byteLength", 0}}}}};
  f.addFloats({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3");
  f.addAccessor<uint16_t>({0, 1, 2}, 5123, "SCALAR");
  f.json["meshes"] = {
      {{"name", "shape"}, {"primitives", {{{"attributes", {{"POSITION", 0}}}, {"indices", 1}, {"material", 0}}}}}};
  return f;
}

int GltfFile::addView(const std::string& data) {
  bytes.resize((bytes.size() + 3) / 4 * 4);
  json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", bytes.size()}, {"byteLength", data.size()}});
  bytes += data;
  return static_cast<int>(json["bufferViews"].size()) - 1;
}

std::string GltfFile::glb() const {
  nlohmann::json filled = json;
  if (filled["buffers"].is_array() && !filled["buffers"].empty() && filled["buffers"][0]["byteLength"] == 0)
    filled["buffers"][0]["byteLength"] = bytes.size();
  std::string text = filled.dump(), binary = bytes;
  text.resize((text.size() + 3) / 4 * 4, ' ');
  binary.resize((binary.size() + 3) / 4 * 4);
  return "glTF" + word(2) + word(28 + text.size() + binary.size()) + word(text.size()) + "JSON" + text +
         word(binary.size()) + std::string("BIN\0", 4) + binary;
}

Result<Imported> GltfFile::import(const std::filesystem::path& file, const ImportOptions& options) const {
  writeFile(file, glb());
  return importScene(file, options);
}

std::string pngOf(int width, int height, float grey) {
  const TemporaryFolder folder;
  Image image(width, height);
  for (Vec3& p : image.pixels) p = Vec3(grey);
  if (!writePng(folder / "a.png", image, {}).ok()) return {};
  return readFile(folder / "a.png");
}

}  // namespace roomlight::testing
