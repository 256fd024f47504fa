#include "import/scene_kind.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstring>
#include <fstream>

#include "import/failure.h"
#include "import/import.h"
#include "import/sh3d_archive.h"

namespace roomlight::importers {
namespace {

constexpr size_t kBeginning = 4096;

struct Extension {
  std::string_view text;
  SceneKind kind;
};
constexpr std::array kExtensions = {
    Extension{".glb", SceneKind::Gltf},    Extension{".gltf", SceneKind::Gltf},    Extension{".sh3d", SceneKind::Sh3d},
    Extension{".sh3f", SceneKind::Sh3f},   Extension{".obj", SceneKind::Obj},      Extension{".fbx", SceneKind::Fbx},
    Extension{".dae", SceneKind::Collada}, Extension{".3ds", SceneKind::Studio3D}, Extension{".ply", SceneKind::Ply},
    Extension{".stl", SceneKind::Stl},     Extension{".zip", SceneKind::Zip},      Extension{".kmz", SceneKind::Zip}};

struct Foreign {
  std::string_view extension, what, instead;
};
constexpr std::string_view kGlb = "glTF (.glb)";
constexpr std::array kForeign = {Foreign{".usdz", "USD", kGlb},
                                 Foreign{".usd", "USD", kGlb},
                                 Foreign{".usda", "USD", kGlb},
                                 Foreign{".usdc", "USD", kGlb},
                                 Foreign{".blend", "Blender's own format", kGlb},
                                 Foreign{".skp", "SketchUp's own format", "COLLADA (.dae) or glTF (.glb)"},
                                 Foreign{".ifc", "IFC", "glTF (.glb), for example with Blender and Bonsai"},
                                 Foreign{".max", "3ds Max's own format", "FBX or glTF (.glb)"},
                                 Foreign{".ma", "Maya's own format", "FBX"},
                                 Foreign{".mb", "Maya's own format", "FBX"},
                                 Foreign{".c4d", "Cinema 4D's own format", "glTF (.glb) or FBX"},
                                 Foreign{".step", "STEP", "glTF (.glb) or STL"},
                                 Foreign{".stp", "STEP", "glTF (.glb) or STL"},
                                 Foreign{".iges", "IGES", "STL"},
                                 Foreign{".igs", "IGES", "STL"},
                                 Foreign{".3dm", "Rhino's own format", "glTF (.glb) or OBJ"},
                                 Foreign{".dwg", "AutoCAD's own format", "FBX"},
                                 Foreign{".dxf", "DXF", "FBX or OBJ"},
                                 Foreign{".rvt", "Revit's own format", "FBX"},
                                 Foreign{".pln", "Archicad's own format", "OBJ or FBX"},
                                 Foreign{".fcstd", "FreeCAD's own format", kGlb},
                                 Foreign{".lwo", "LightWave's own format", "OBJ or FBX"},
                                 Foreign{".x3d", "X3D", kGlb},
                                 Foreign{".wrl", "VRML", kGlb},
                                 Foreign{".abc", "Alembic", kGlb},
                                 Foreign{".3mf", "3MF", "STL or OBJ"},
                                 Foreign{".vrm", "VRM", kGlb},
                                 Foreign{".babylon", "Babylon's own format", kGlb},
                                 Foreign{".splat", "a cloud of splats", "a mesh as glTF (.glb)"}};

std::string lowerExtension(const std::filesystem::path& file) {
  std::string out = file.extension().string();
  std::transform(out.begin(), out.end(), out.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return out;
}

std::string_view trimmedStart(std::string_view text) {
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
  text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
  return text;
}

uint32_t word(std::string_view bytes, size_t at) {
  uint32_t v = 0;
  if (at + 4 <= bytes.size()) std::memcpy(&v, bytes.data() + at, 4);
  return v;
}

// Lines that begin as those of OBJ files do, and nothing that no text holds.
bool looksLikeObj(std::string_view text) {
  if (text.find('\0') != std::string_view::npos) return false;
  constexpr std::array kWords = {"v ", "vn ", "vt ", "f ", "o ", "g ", "usemtl ", "mtllib ", "s "};
  size_t known = 0, vertices = 0;
  for (size_t at = 0; at < text.size();) {
    const size_t end = std::min(text.find('\n', at), text.size());
    const std::string_view line = text.substr(at, end - at);
    at = end + 1;
    if (line.starts_with("v ")) ++vertices;
    const bool blank = line.empty() || line[0] == '#' || line[0] == '\r';
    if (!blank && !std::any_of(kWords.begin(), kWords.end(), [&](const char* w) { return line.starts_with(w); }) &&
        at < text.size())
      return false;
    if (!blank) ++known;
  }
  return known > 2 && (vertices > 0 || text.find("mtllib ") != std::string_view::npos);
}

std::string beginningOf(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::string out(kBeginning, '\0');
  in.read(out.data(), static_cast<std::streamsize>(out.size()));
  out.resize(static_cast<size_t>(std::max<std::streamsize>(in.gcount(), 0)));
  return out;
}

// A home or a furniture library may have the name of any archive.
SceneKind kindOfArchive(const std::filesystem::path& file) {
  const Bytes bytes = readWholeFile(file, "");
  const Archive archive(bytes, "");
  if (archive.has("Home.xml") || archive.has("Home")) return SceneKind::Sh3d;
  return archive.has("PluginFurnitureCatalog.properties") ? SceneKind::Sh3f : SceneKind::Zip;
}

}  // namespace

std::optional<SceneKind> kindByExtension(const std::filesystem::path& file) {
  const std::string extension = lowerExtension(file);
  for (const Extension& e : kExtensions) {
    if (e.text == extension) return e.kind;
  }
  return {};
}

std::optional<SceneKind> kindByContent(std::string_view beginning, uintmax_t size) {
  if (beginning.starts_with("glTF")) return SceneKind::Gltf;
  if (beginning.starts_with("PK\x03\x04")) return SceneKind::Zip;
  if (beginning.starts_with("Kaydara FBX Binary")) return SceneKind::Fbx;
  if (beginning.starts_with("ply\n") || beginning.starts_with("ply\r")) return SceneKind::Ply;
  if (beginning.starts_with("MM") && size >= 6 && word(beginning, 2) == size) return SceneKind::Studio3D;
  if (size >= 84 && beginning.size() >= 84 && 84 + uintmax_t{50} * word(beginning, 80) == size) return SceneKind::Stl;
  const std::string_view text = trimmedStart(beginning);
  if (text.starts_with("; FBX ")) return SceneKind::Fbx;
  if (text.starts_with('<') && text.find("<COLLADA") != std::string_view::npos) return SceneKind::Collada;
  if (text.starts_with('{') && text.find("\"asset\"") != std::string_view::npos) return SceneKind::Gltf;
  if (text.starts_with("solid") && text.find("facet") != std::string_view::npos) return SceneKind::Stl;
  if (looksLikeObj(text)) return SceneKind::Obj;
  return {};
}

SceneKind kindOf(const std::filesystem::path& file) {
  std::error_code code;
  const uintmax_t size = std::filesystem::file_size(file, code);
  const auto byName = kindByExtension(file);
  const auto byContent = kindByContent(beginningOf(file), code ? 0 : size);
  if (byContent == SceneKind::Zip) {
    if (byName == SceneKind::Sh3d || byName == SceneKind::Sh3f) return *byName;
    if (std::string advice = adviceFor(file); !advice.empty()) fail("", advice);
    return kindOfArchive(file);
  }
  if (byContent) return *byContent;
  if (byName) return *byName;
  if (std::string advice = adviceFor(file); !advice.empty()) fail("", advice);
  fail("", fmt::format("unknown kind of file '{}'; use {}", printable(file.extension().string()), supportedFiles()));
}

std::string adviceFor(const std::filesystem::path& file) {
  const std::string extension = lowerExtension(file);
  for (const Foreign& f : kForeign) {
    if (f.extension == extension) return fmt::format("is in {}, which is not read; export it as {}", f.what, f.instead);
  }
  return {};
}

}  // namespace roomlight::importers
