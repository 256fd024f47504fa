#include "import/sh3d_models.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "import/failure.h"
#include "import/obj.h"

namespace roomlight::importers::sh3d {
namespace {

std::string extensionOf(std::string_view name) {
  const size_t dot = name.rfind('.'), slash = name.rfind('/');
  if (dot == std::string_view::npos || (slash != std::string_view::npos && dot < slash)) return {};
  std::string out(name.substr(dot + 1));
  std::transform(out.begin(), out.end(), out.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return out;
}

bool startsWith(const Bytes& bytes, std::string_view magic) {
  return bytes.size() >= magic.size() && std::equal(magic.begin(), magic.end(), bytes.begin(), [](char c, uint8_t b) { return static_cast<uint8_t>(c) == b; });
}

// Why a model is no OBJ; empty where it may be one. Entries of single files are named by a number without an extension.
std::string otherFormat(const std::string& extension, const Bytes& bytes) {
  if (extension == "dae" || extension == "kmz" || startsWith(bytes, "<?xml") || startsWith(bytes, "<COLLADA")) return "COLLADA (.dae, .kmz)";
  if (extension == "3ds" || startsWith(bytes, "MM")) return "3D Studio (.3ds)";
  if (extension == "lws" || startsWith(bytes, "LWSC")) return "LightWave (.lws)";
  if (extension == "gltf" || extension == "glb" || startsWith(bytes, "glTF")) return "glTF";
  return {};
}

// Companions of an entry: entries beside and below it. Some models name pictures on their author's disk: those are missing, as no entry has
// such a name.
ReadCompanion companionsOf(const Archive& archive, const std::string& entry) {
  const size_t slash = entry.rfind('/');
  const std::string folder = slash == std::string::npos ? "" : entry.substr(0, slash + 1);
  return [&archive, folder](std::string_view reference, const std::string&) -> std::optional<Bytes> {
    const auto name = normalisedEntryName(reference);
    return name ? archive.read(folder + *name) : std::nullopt;
  };
}

}  // namespace

Scene Models::read(const std::string& entry) {
  const auto bytes = archive_.read(entry);
  if (!bytes) fail("", "is missing");
  const std::string other = otherFormat(extensionOf(entry), *bytes);
  if (!other.empty()) fail("", "is in the format " + other + ", which is not read; export it as OBJ");
  if (!startsWith(*bytes, "PK\x03\x04")) return readObj(*bytes, companionsOf(archive_, entry), maxTriangles_, warnings_);
  // A zip file in the zip file: the first model in it.
  const Archive inner(*bytes, fmt::format("entry '{}'", printable(entry)), {.entryBytes = size_t{256} << 20, .totalBytes = size_t{1} << 30});
  for (const std::string& name : inner.names()) {
    if (extensionOf(name) == "obj") return readObj(*inner.read(name), companionsOf(inner, name), maxTriangles_, warnings_);
  }
  fail("", "is a zip file without an OBJ file; export it as OBJ");
}

const Model* Models::find(const std::string& entry) {
  const auto [it, isNew] = models_.try_emplace(entry);
  Model& model = it->second;
  if (isNew) {
    try {
      Scene scene = read(entry);
      const int firstMaterial = static_cast<int>(scene_.materials.size()), firstTexture = static_cast<int>(scene_.textures.size());
      for (Texture& t : scene.textures) scene_.textures.push_back(std::move(t));
      for (Material& m : scene.materials) {
        for (TextureRef* ref : {&m.baseColorTexture, &m.metallicRoughnessTexture, &m.normalTexture, &m.emissionTexture, &m.transmissionTexture}) {
          if (ref->texture >= 0) ref->texture += firstTexture;
        }
        scene_.materials.push_back(std::move(m));
      }
      for (const Instance& i : scene.instances) {
        model.meshes.push_back(std::move(scene.meshes[static_cast<size_t>(i.mesh)]));
        model.meshes.back().material += firstMaterial;
        model.objects.push_back(i.object);
      }
    } catch (const Failure& failure) {
      warnings_.add(fmt::format("the model '{}' {}", printable(entry), printable(failure.what(), 200)));
    }
  }
  return model.meshes.empty() ? nullptr : &model;
}

}  // namespace roomlight::importers::sh3d
