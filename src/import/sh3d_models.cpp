#include "import/sh3d_furniture.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cctype>

#include "import/failure.h"
#include "import/foreign_import.h"
#include "import/obj.h"
#include "import/pictures.h"

namespace roomlight::importers::sh3d {
namespace {

enum class Format {
  Obj,
  Collada,
  Studio3D,
  Zip,
  LightWave,
  Gltf,
};

std::string extensionOf(std::string_view name) {
  const size_t dot = name.rfind('.'), slash = name.rfind('/');
  if (dot == std::string_view::npos || (slash != std::string_view::npos && dot < slash)) return {};
  std::string out(name.substr(dot + 1));
  std::transform(out.begin(), out.end(), out.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return out;
}

bool startsWith(const Bytes& bytes, std::string_view magic) {
  return bytes.size() >= magic.size() && std::equal(magic.begin(), magic.end(), bytes.begin(),
                                                    [](char c, uint8_t b) { return static_cast<uint8_t>(c) == b; });
}

// Entries of single files are named by a number without an extension.
Format formatOf(const std::string& extension, const Bytes& bytes) {
  if (startsWith(bytes, "PK\x03\x04")) return Format::Zip;
  if (extension == "dae" || startsWith(bytes, "<?xml") || startsWith(bytes, "\xef\xbb\xbf<?xml") ||
      startsWith(bytes, "<COLLADA"))
    return Format::Collada;
  if (extension == "3ds" || startsWith(bytes, "MM")) return Format::Studio3D;
  if (extension == "lws" || startsWith(bytes, "LWSC")) return Format::LightWave;
  if (extension == "gltf" || extension == "glb" || startsWith(bytes, "glTF")) return Format::Gltf;
  return Format::Obj;
}

bool isModelName(const std::string& name) {
  const std::string extension = extensionOf(name);
  return extension == "obj" || extension == "dae" || extension == "3ds";
}

constexpr size_t kMaxInnerBytes = size_t{4} << 30;  // of the archives in the archive, unpacked

// What all models of a home may hold together.
struct Budget {
  size_t maxTriangles = 0;
  std::atomic<size_t> triangles{0}, pixels{0}, innerBytes{0};
  bool exceeded() const { return triangles > maxTriangles || pixels > kMaxAllPixels || innerBytes > kMaxInnerBytes; }
};

void spendInner(size_t bytes, Budget& budget) {
  if ((budget.innerBytes += bytes) > kMaxInnerBytes) fail("", "unpacks to too much beside those of other models");
}

// "models/../images/oak.jpg" without the steps up; none where it climbs out of the archive.
std::optional<std::string> withoutSteps(std::string path) {
  std::replace(path.begin(), path.end(), '\\', '/');
  std::string out;
  for (size_t at = 0; at <= path.size();) {
    const size_t end = std::min(path.find('/', at), path.size());
    const std::string part = path.substr(at, end - at);
    if (part == "..") {
      if (out.empty()) return {};
      out.erase(out.rfind('/') == std::string::npos ? 0 : out.rfind('/'));
    } else if (!part.empty() && part != ".") {
      out += (out.empty() ? "" : "/") + part;
    }
    at = end + 1;
  }
  return normalisedEntryName(out);
}

// Companions of an entry: entries beside, below or, inside its own archive, above it. Some models name pictures on
// their author's disk: of those the file's name counts, beside the model.
ReadCompanion companionsOf(Content& content, const std::string& entry, bool isInner, Budget& budget) {
  const size_t slash = entry.rfind('/');
  const std::string folder = slash == std::string::npos ? "" : entry.substr(0, slash + 1);
  return [&content, &budget, folder, isInner](std::string_view reference, const std::string&) -> std::optional<Bytes> {
    const std::string name(reference);
    const auto path = name.starts_with('/') || name.starts_with('\\') ? std::nullopt : withoutSteps(folder + name);
    const Bytes* bytes = path ? content.read(*path) : nullptr;
    const size_t lastSlash = name.find_last_of("/\\");
    if (!bytes && lastSlash != std::string::npos && lastSlash + 1 < name.size())
      bytes = content.read(folder + name.substr(lastSlash + 1));
    if (!bytes) return {};
    if (isInner) spendInner(bytes->size(), budget);
    if ((budget.pixels += claimedPixels(*bytes)) > kMaxAllPixels)
      fail("", "has too many pictures beside those of other models");
    return *bytes;
  };
}

Scene readModel(const std::string& entry, Content& content, bool isInner, Budget& budget, Warnings& warnings) {
  const size_t maxTriangles = budget.maxTriangles;
  const Bytes* bytes = content.read(entry);
  if (!bytes) fail("", "is missing");
  const ReadCompanion companions = companionsOf(content, entry, isInner, budget);
  switch (formatOf(extensionOf(entry), *bytes)) {
    case Format::Obj: return readObj(*bytes, companions, maxTriangles, warnings);
    case Format::Collada: return readByAssimp(*bytes, AssimpFormat::Collada, companions, maxTriangles, warnings);
    case Format::Studio3D: return readByAssimp(*bytes, AssimpFormat::Studio3D, companions, maxTriangles, warnings);
    case Format::LightWave: fail("", "is in the format LightWave (.lws), which is not read; export it as OBJ");
    case Format::Gltf: fail("", "is in the format glTF, which is not read inside a home; export it as OBJ");
    case Format::Zip: break;
  }
  // A zip file in the zip file (also .kmz): the first model in it. Some zip files hold themselves, without end.
  if (isInner) fail("", "is a zip file in a zip file in the home; export it as OBJ");
  const Archive inner(*bytes, fmt::format("entry '{}'", printable(entry)),
                      {.entryBytes = size_t{256} << 20, .totalBytes = size_t{1} << 30});
  Content innerContent(inner);
  for (const std::string& name : inner.names()) {
    if (!isModelName(name)) continue;
    spendInner(inner.sizeOf(name), budget);
    return readModel(name, innerContent, true, budget, warnings);
  }
  fail("", "is a zip file without a model in OBJ, COLLADA or 3D Studio format; export it as OBJ");
}

struct Read {
  Scene scene;
  Warnings warnings;
};

void readOne(const Archive& archive, const ContentDigests& digests, const std::string& entry, Budget& budget,
             Read& out) {
  if (budget.exceeded()) return;
  const std::string model = fmt::format("the model '{}' ", printable(entry));
  try {
    Content content(archive);
    out.scene = readModel(entry, content, false, budget, out.warnings);
    if (out.scene.instances.empty()) fail("", "holds no triangles");
    budget.triangles += out.scene.triangleCount();
    const auto digest = digests.of(entry);
    if (digest && !content.has(*digest, entry))
      out.warnings.add(model + "is not what was saved, its digest differs: it is damaged, or was exchanged");
  } catch (const Failure& failure) {
    out.scene = {};
    out.warnings.add(model + printable(failure.what(), 200));
  }
}

// Its materials and textures behind those of the home.
Model merged(Scene& from, Scene& scene) {
  Model model;
  const int firstMaterial = static_cast<int>(scene.materials.size()),
            firstTexture = static_cast<int>(scene.textures.size());
  for (Texture& t : from.textures) scene.textures.push_back(std::move(t));
  for (Material& m : from.materials) {
    for (TextureRef* ref : {&m.baseColorTexture, &m.metallicRoughnessTexture, &m.normalTexture, &m.emissionTexture,
                            &m.transmissionTexture}) {
      if (ref->texture >= 0) ref->texture += firstTexture;
    }
    scene.materials.push_back(std::move(m));
  }
  for (const Instance& i : from.instances) {
    model.meshes.push_back(std::move(from.meshes[static_cast<size_t>(i.mesh)]));
    model.meshes.back().material += firstMaterial;
    model.objects.push_back(i.object);
  }
  return model;
}

}  // namespace

Models::Models(const Archive& archive, const ContentDigests& digests, const std::set<std::string>& entries,
               size_t maxTriangles, Scene& scene, Warnings& warnings) {
  const std::vector<std::string> names(entries.begin(), entries.end());
  std::vector<Read> read(names.size());
  Budget budget;
  budget.maxTriangles = maxTriangles;
  parallelOrFail(names.size(), [&](size_t i) { readOne(archive, digests, names[i], budget, read[i]); });
  if (budget.triangles > maxTriangles)
    fail("", fmt::format("the models together have more than {} triangles", maxTriangles));
  if (budget.innerBytes > kMaxInnerBytes)
    fail("", fmt::format("the archives of all models together unpack to more than {} MiB", kMaxInnerBytes >> 20));
  if (budget.pixels > kMaxAllPixels)
    fail("", fmt::format("the pictures of all models together have more than {} pixels", kMaxAllPixels));
  for (size_t i = 0; i < names.size(); ++i) {
    warnings.add(read[i].warnings);
    if (!read[i].scene.instances.empty()) models_.emplace(names[i], merged(read[i].scene, scene));
  }
}

const Model* Models::find(const std::string& entry) const {
  const auto it = models_.find(entry);
  return it == models_.end() ? nullptr : &it->second;
}

}  // namespace roomlight::importers::sh3d
