// glTF 2.0 container (Khronos specification 2.0.1, section 4.4): text JSON, or GLB: magic "glTF", version 2, length;
// then chunks of (length, type, bytes): one JSON chunk and at most one BIN chunk. All numbers little-endian.
#include "import/gltf_document.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <map>

#include "import/failure.h"

namespace roomlight::importers {
namespace {

constexpr size_t kMaxJsonDepth = 64;
constexpr size_t kMaxJsonValues = 50'000'000;  // each takes some forty bytes, whatever it takes in the file

constexpr size_t kElementsPerByte = 64;  // Draco spends a byte on about five

constexpr std::array<std::string_view, 19> kHonoured = {"EXT_mesh_gpu_instancing",
                                                        "EXT_meshopt_compression",
                                                        "EXT_texture_avif",
                                                        "EXT_texture_webp",
                                                        "KHR_draco_mesh_compression",
                                                        "KHR_lights_punctual",
                                                        "KHR_materials_emissive_strength",
                                                        "KHR_materials_ior",
                                                        "KHR_materials_pbrSpecularGlossiness",
                                                        "KHR_materials_specular",
                                                        "KHR_materials_transmission",
                                                        "KHR_materials_unlit",
                                                        "KHR_materials_volume",
                                                        "KHR_mesh_quantization",
                                                        "KHR_meshopt_compression",
                                                        "KHR_node_visibility",
                                                        "KHR_texture_basisu",
                                                        "KHR_texture_transform",
                                                        "MSFT_texture_dds"};

// What a file may require and still shows right without: animation, sound, data about things, other levels of detail,
// light of pictures.
constexpr std::array<std::string_view, 17> kHarmless = {"AGI_",
                                                        "CESIUM_primitive_outline",
                                                        "EXT_feature_metadata",
                                                        "EXT_instance_features",
                                                        "EXT_lights_",
                                                        "EXT_mesh_features",
                                                        "EXT_structural_metadata",
                                                        "FB_geometry_metadata",
                                                        "KHR_animation_pointer",
                                                        "KHR_audio",
                                                        "KHR_interactivity",
                                                        "KHR_node_",
                                                        "KHR_physics_",
                                                        "KHR_xmp",
                                                        "MSFT_audio_emitter",
                                                        "MSFT_lod",
                                                        "VRMC_"};

bool honoured(std::string_view name) { return std::find(kHonoured.begin(), kHonoured.end(), name) != kHonoured.end(); }

// Extensions that only refine the metallic-roughness material, which a file always has beside them: clearcoat, sheen,
// variants, ...
bool refinesMaterials(std::string_view name) {
  return name.find("_materials_") != std::string_view::npos || name.starts_with("MSFT_packing_");
}

bool harmless(std::string_view name) {
  return std::any_of(kHarmless.begin(), kHarmless.end(),
                     [&](std::string_view prefix) { return name.starts_with(prefix); });
}

uint32_t word(const Bytes& bytes, size_t offset) {
  uint32_t v;
  std::memcpy(&v, bytes.data() + offset, 4);
  return v;
}

constexpr const char* kFirstVersion =
    "glTF 1.0 is not read; convert it to 2.0, for example with Blender or gltf-pipeline";

std::string_view jsonOfBinary(GltfDocument& document) {
  const Bytes& file = document.file;
  if (file.size() >= 8 && word(file, 4) == 1) fail("", kFirstVersion);
  if (file.size() < 20) fail("", "the file is cut short");
  if (word(file, 4) != 2) fail("header", fmt::format("binary glTF version {} is not supported, only 2", word(file, 4)));
  // The stated length of the whole is often wrong; those of the chunks say what is there.
  if (word(file, 8) != file.size()) document.warnings.add("the file's stated length is not its own");
  std::string_view json;
  for (size_t at = 12, chunk = 0; chunk < 2 && at + 8 <= file.size(); ++chunk) {
    const size_t length = word(file, at), left = file.size() - at - 8;
    const uint32_t type = word(file, at + 4);
    at += 8;
    if (chunk == 0 && type != 0x4e4f534a) fail("chunk 0", "is not the JSON chunk");
    if (chunk == 0 && length > left)
      fail("chunk 0", fmt::format("the file is cut short: {} bytes of {}", left, length));
    if (chunk == 0) json = {reinterpret_cast<const char*>(file.data()) + at, length};
    if (chunk == 1 && type == 0x004e4942) document.binaryChunk = std::span(file).subspan(at, std::min(length, left));
    at += std::min(length, left);
  }
  return json;
}

// Text as JSON has it: without a byte order mark and zeros that fill a chunk, and with '?' for bytes that are no UTF-8.
std::string cleaned(std::string_view text) {
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
  while (text.ends_with('\0')) text.remove_suffix(1);
  std::string out(text);
  for (size_t i = 0; i < out.size();) {
    const auto byte = [&](size_t k) { return i + k < out.size() ? static_cast<unsigned char>(out[i + k]) : 0u; };
    const unsigned first = byte(0);
    const size_t length = first < 0x80                    ? 1
                          : first >= 0xc2 && first < 0xe0 ? 2
                          : first >= 0xe0 && first < 0xf0 ? 3
                          : first >= 0xf0 && first < 0xf5 ? 4
                                                          : 0;
    bool valid = length > 0;
    for (size_t k = 1; k < length; ++k) valid = valid && (byte(k) & 0xc0) == 0x80;
    // Overlong forms, surrogates and what lies beyond Unicode.
    if ((first == 0xe0 && byte(1) < 0xa0) || (first == 0xed && byte(1) > 0x9f) || (first == 0xf0 && byte(1) < 0x90) ||
        (first == 0xf4 && byte(1) > 0x8f))
      valid = false;
    if (!valid) out[i] = '?';
    i += valid ? length : 1;
  }
  return out;
}

// Before parsing, since everything that walks the tree later may recurse.
void checkShape(const std::string& json) {
  size_t depth = 0, values = 0;
  bool text = false;
  for (size_t i = 0; i < json.size(); ++i) {
    const char c = json[i];
    if (text) {
      if (c == '\\') ++i;
      if (c == '"') text = false;
    } else if (c == '"') {
      text = true;
    } else if (c == '{' || c == '[') {
      if (++depth > kMaxJsonDepth)
        fail("JSON", fmt::format("is nested deeper than {} levels at byte {}", kMaxJsonDepth, i));
    } else if ((c == '}' || c == ']') && depth > 0) {
      --depth;
    }
    // Each value but the first follows one of these.
    if (!text && (c == '{' || c == '[' || c == ',') && ++values > kMaxJsonValues)
      fail("JSON", fmt::format("holds more than {} values", kMaxJsonValues));
  }
}

void countUnknown(const nlohmann::json& value, std::map<std::string, size_t>& counts) {
  if (value.is_array()) {
    for (const auto& element : value) countUnknown(element, counts);
  } else if (value.is_object()) {
    for (const auto& [key, member] : value.items()) {
      if (key == "extras") continue;
      if (key == "extensions" && member.is_object()) {
        for (const auto& [name, extension] : member.items()) {
          if (!honoured(name)) ++counts[name];
        }
      }
      countUnknown(member, counts);
    }
  }
}

// Files of version 1 keep things in objects by name, where version 2 has lists.
bool hasShapeOfFirstVersion(const nlohmann::json& root) {
  for (const char* key : {"nodes", "meshes", "buffers", "accessors"}) {
    if (const auto it = root.find(key); it != root.end() && it->is_object()) return true;
  }
  return false;
}

void checkVersion(GltfDocument& document) {
  const Json root = document.root();
  const auto asset = root.find("asset");
  const auto version = asset ? asset->find("version") : std::nullopt;
  const std::string stated = !version                     ? ""
                             : version->raw().is_number() ? fmt::format("{}", version->number())
                                                          : version->text();
  if (stated.starts_with("1") || stated.starts_with("0") || hasShapeOfFirstVersion(document.json))
    fail("", kFirstVersion);
  if (stated.empty()) {
    document.warnings.add("the file states no version and is taken as glTF 2.0");
  } else if (stated != "2" && !stated.starts_with("2.")) {
    version->fail(fmt::format("is '{}', only glTF 2.x is supported", printable(stated)));
  }
  const std::string minimum = asset ? asset->text("minVersion", "2.0") : "2.0";
  if (minimum != "2.0") asset->at("minVersion").fail(fmt::format("is '{}', only 2.0 is supported", printable(minimum)));
}

}  // namespace

void ElementBudget::grantFor(size_t fileBytes) { left_ += kElementsPerByte * fileBytes; }

void ElementBudget::spend(size_t elements, const std::string& place) {
  if (elements > left_)
    fail(place, "the file unfolds into far more vertices, indices or placements than its size explains");
  left_ -= elements;
}

void parseContainer(GltfDocument& document) {
  const Bytes& file = document.file;
  std::string_view text(reinterpret_cast<const char*>(file.data()), file.size());
  if (text.starts_with("glTF")) text = jsonOfBinary(document);
  const std::string json = cleaned(text);
  checkShape(json);
  try {
    document.json = nlohmann::json::parse(json.begin(), json.end());
  } catch (const nlohmann::json::parse_error& e) {
    const size_t line =
        1 + static_cast<size_t>(std::count(
                json.begin(), json.begin() + static_cast<std::ptrdiff_t>(std::min(e.byte, json.size())), '\n'));
    fail("JSON", fmt::format("line {}, byte {}: is not valid JSON; the file is damaged or no glTF", line, e.byte));
  } catch (const nlohmann::json::exception&) {
    fail("JSON", "holds a number out of range");
  }
  checkVersion(document);
}

void checkExtensions(GltfDocument& document) {
  const Json required = document.root().list("extensionsRequired");
  for (size_t i = 0; i < required.size(); ++i) {
    const std::string& name = required[i].text();
    if (!honoured(name) && !refinesMaterials(name) && !harmless(name))
      required[i].fail(fmt::format("the file requires '{}', which is not supported", printable(name)));
  }
  std::map<std::string, size_t> unknown;
  countUnknown(document.json, unknown);
  Listed looks, others;
  for (const auto& [name, count] : unknown) (refinesMaterials(name) ? looks : others).add(printable(name), count);
  looks.addTo(document.warnings, "looks that are not supported show as their base material: ");
  others.addTo(document.warnings, "extensions that are not supported are ignored: ");
  const size_t animations = document.root().list("animations").size();
  if (animations > 0)
    document.warnings.add("animations are ignored, things stay where their nodes put them", animations);
}

std::unique_ptr<GltfDocument> openGltf(const std::filesystem::path& file) {
  auto document = std::make_unique<GltfDocument>();
  document->folder = file.parent_path();
  document->file = readWholeFile(file, "");
  document->budget.grantFor(document->file.size());
  parseContainer(*document);
  checkExtensions(*document);
  loadBuffers(*document);
  return document;
}

}  // namespace roomlight::importers
