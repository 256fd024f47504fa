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

constexpr size_t kElementsPerByte = 64;  // Draco spends a byte on about five

// clang-format off
constexpr std::array kHonoured = {
    "EXT_mesh_gpu_instancing",    "EXT_meshopt_compression",     "EXT_texture_webp",
    "KHR_draco_mesh_compression", "KHR_lights_punctual",         "KHR_materials_emissive_strength",
    "KHR_materials_ior",          "KHR_materials_specular",      "KHR_materials_transmission",
    "KHR_materials_unlit",        "KHR_materials_volume",        "KHR_mesh_quantization",
    "KHR_meshopt_compression",    "KHR_texture_basisu",          "KHR_texture_transform"};
// clang-format on

bool honoured(std::string_view name) { return std::find(kHonoured.begin(), kHonoured.end(), name) != kHonoured.end(); }

uint32_t word(const Bytes& bytes, size_t offset) {
  uint32_t v;
  std::memcpy(&v, bytes.data() + offset, 4);
  return v;
}

std::string_view jsonOfBinary(GltfDocument& document) {
  const Bytes& file = document.file;
  if (file.size() < 20) fail("", "the file is cut short");
  if (word(file, 4) != 2) fail("header", fmt::format("binary glTF version {} is not supported, only 2", word(file, 4)));
  if (word(file, 8) > file.size()) fail("header", fmt::format("the file is cut short: {} bytes of {}", file.size(), word(file, 8)));
  const size_t end = word(file, 8);
  std::string_view json;
  for (size_t at = 12, chunk = 0; at + 8 <= end; ++chunk) {
    const size_t length = word(file, at);
    const uint32_t type = word(file, at + 4);
    at += 8;
    if (length > end - at) fail(fmt::format("chunk {}", chunk), "reaches beyond the end of the file");
    if (chunk == 0 && type != 0x4e4f534a) fail("chunk 0", "is not the JSON chunk");
    if (chunk == 0) json = {reinterpret_cast<const char*>(file.data()) + at, length};
    if (chunk == 1 && type == 0x004e4942) document.binaryChunk = {file.data() + at, length};
    at += length;
  }
  return json;
}

// Before parsing, since everything that walks the tree later may recurse.
void checkDepth(std::string_view json) {
  size_t depth = 0;
  bool text = false;
  for (size_t i = 0; i < json.size(); ++i) {
    const char c = json[i];
    if (text) {
      if (c == '\\') ++i;
      if (c == '"') text = false;
    } else if (c == '"') {
      text = true;
    } else if (c == '{' || c == '[') {
      if (++depth > kMaxJsonDepth) fail("JSON", fmt::format("is nested deeper than {} levels at byte {}", kMaxJsonDepth, i));
    } else if ((c == '}' || c == ']') && depth > 0) {
      --depth;
    }
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

}  // namespace

void ElementBudget::grantFor(size_t fileBytes) { left_ += kElementsPerByte * fileBytes; }

void ElementBudget::spend(size_t elements, const std::string& place) {
  if (elements > left_) fail(place, "the file unfolds into far more vertices, indices or placements than its size explains");
  left_ -= elements;
}

void parseContainer(GltfDocument& document) {
  const Bytes& file = document.file;
  std::string_view json(reinterpret_cast<const char*>(file.data()), file.size());
  if (json.starts_with("glTF")) json = jsonOfBinary(document);
  checkDepth(json);
  try {
    document.json = nlohmann::json::parse(json.begin(), json.end());
  } catch (const nlohmann::json::parse_error& e) {
    const size_t line = 1 + static_cast<size_t>(std::count(json.begin(), json.begin() + static_cast<std::ptrdiff_t>(std::min(e.byte, json.size())), '\n'));
    fail("JSON", fmt::format("line {}, byte {}: is not valid JSON; the file is damaged or no glTF", line, e.byte));
  } catch (const nlohmann::json::exception&) {
    fail("JSON", "holds a number out of range");
  }
  const Json root = document.root();
  const std::string version = root.at("asset").at("version").text();
  if (!version.starts_with("2.")) root.at("asset").at("version").fail(fmt::format("is '{}', only glTF 2.x is supported", printable(version)));
  const std::string minimum = root.at("asset").text("minVersion", "2.0");
  if (minimum != "2.0") root.at("asset").at("minVersion").fail(fmt::format("is '{}', only 2.0 is supported", printable(minimum)));
}

void checkExtensions(GltfDocument& document) {
  const Json required = document.root().list("extensionsRequired");
  for (size_t i = 0; i < required.size(); ++i) {
    if (!honoured(required[i].text())) required[i].fail(fmt::format("the file requires '{}', which is not supported", printable(required[i].text())));
  }
  std::map<std::string, size_t> unknown;
  countUnknown(document.json, unknown);
  for (const auto& [name, count] : unknown) document.warnings.add(printable(name) + " is not supported and ignored", count);
  const size_t animations = document.root().list("animations").size();
  if (animations > 0) document.warnings.add("animations are ignored, things stay where their nodes put them", animations);
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
