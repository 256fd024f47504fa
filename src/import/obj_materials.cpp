// MTL, as exporters write it: Kd colour, Ke emission, d or Tr = 1 - d, Ns shininess of Blinn-Phong, Ni refraction; with
// the PBR extension Pr roughness, Pm metallic, norm; map_X: a picture that multiplies X, after options such as "-s 2
// 2".
#include "import/obj.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#define TINYOBJLOADER_IMPLEMENTATION
#include <tiny_obj_loader.h>

#include "base/utf8.h"
#include "import/failure.h"
#include "import/grey_material.h"
#include "import/obj_lines.h"

namespace roomlight::importers {
namespace {

constexpr size_t kMaxMaterials = 1 << 16;
constexpr float kBrightest = 1e12f;

struct Libraries {
  std::vector<tinyobj::material_t> materials;
  std::map<std::string, int> indices;
};

bool isNumber(const std::string& word) {
  return !word.empty() && word.find_first_not_of("+-.0123456789eE") == std::string::npos &&
         word.find_first_of("0123456789") != std::string::npos;
}

// The options -s, -o and -t take one to three numbers, but the parser wants three: the rest are filled in.
std::string withAllNumbers(const std::string& text) {
  std::string out;
  int missing = 0;
  const char* filler = "";
  for (size_t at = 0; at < text.size();) {
    const size_t end = std::min(text.find_first_of(" \t\r\n", at), text.size());
    const std::string word = text.substr(at, end - at);
    const bool wanted = missing > 0 && (isNumber(word) || word.empty());
    for (; missing > 0 && !wanted; --missing) out += filler;
    if (!word.empty() && missing > 0) --missing;
    if (word == "-s" || word == "-o" || word == "-t") missing = 3, filler = word == "-s" ? "1 " : "0 ";
    out += word;
    if (end < text.size()) out += text[end];
    if (end < text.size() && text[end] == '\n') missing = 0;
    at = end + 1;
  }
  return out;
}

// Which materials say opacity as `d`, and which only as `Tr`.
struct Opacities {
  std::set<std::string> byD, byTr;
};

Opacities opacitiesOf(std::string_view text) {
  Opacities out;
  ObjLines lines(text);
  std::string name;
  for (std::string_view line; lines.next(line);) {
    const std::string_view word = nextWord(line);
    line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
    if (word == "newmtl") name = line;
    if (word == "d") out.byD.insert(name);
    if (word == "Tr") out.byTr.insert(name);
  }
  for (const std::string& known : out.byD) out.byTr.erase(known);
  return out;
}

// Nobody draws what cannot be seen. Where a material is wholly transparent by `Tr` alone, its exporter means opacity by
// it; where all of them are by `d`, it means nothing.
void mendOpacities(const Opacities& said, std::vector<tinyobj::material_t>& materials, size_t first,
                   Warnings& warnings) {
  const auto from = materials.begin() + static_cast<std::ptrdiff_t>(first);
  const auto byTr = [&](const tinyobj::material_t& m) { return said.byTr.contains(m.name); };
  const bool swapped =
      std::any_of(from, materials.end(), [&](const tinyobj::material_t& m) { return byTr(m) && m.dissolve <= 0; });
  const bool allUnseen = !said.byD.empty() && std::all_of(from, materials.end(), [&](const tinyobj::material_t& m) {
    return m.dissolve <= 0 && !byTr(m);
  });
  for (auto m = from; m != materials.end(); ++m) {
    if (swapped && byTr(*m)) {
      m->dissolve = 1 - m->dissolve;
      warnings.mended("Tr of an MTL file, by which materials would be invisible, is taken as their opacity");
    } else if (allUnseen) {
      m->dissolve = 1;
      warnings.mended("d of an MTL file, by which all materials would be invisible, is ignored");
    }
  }
}

void readLibrary(const std::string& name, const Bytes& bytes, Libraries& out, Warnings& warnings) {
  std::string_view raw(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  if (raw.starts_with("\xef\xbb\xbf")) raw.remove_prefix(3);
  const std::string text = asUtf8(raw);
  size_t count = 0;
  for (size_t at = text.find("newmtl"); at != std::string::npos && count <= kMaxMaterials;
       at = text.find("newmtl", at + 6))
    ++count;
  if (count > kMaxMaterials)
    fail(fmt::format("mtllib '{}'", printable(name)), fmt::format("holds more than {} materials", kMaxMaterials));
  std::istringstream in(withAllNumbers(text));
  const size_t first = out.materials.size();
  tinyobj::LoadMtl(&out.indices, &out.materials, &in, nullptr, nullptr);
  mendOpacities(opacitiesOf(text), out.materials, first, warnings);
}

// A line may name one library with blanks in its name, or several.
void readLibraries(const ReadCompanion& companions, const std::string& line, Libraries& out, Warnings& warnings) {
  const auto read = [&](const std::string& name) {
    const std::optional<Bytes> bytes = companions(name, fmt::format("mtllib '{}'", printable(name)));
    if (bytes) readLibrary(name, *bytes, out, warnings);
    return bytes.has_value();
  };
  if (read(line)) return;
  const auto missing = [&](const std::string& name) {
    warnings.add(fmt::format("MTL file '{}' is missing, its materials are grey", printable(name)));
  };
  std::vector<std::string> names;
  std::string_view rest = line;
  for (std::string_view word = nextWord(rest); !word.empty(); word = nextWord(rest)) names.emplace_back(word);
  const bool several = std::count_if(names.begin(), names.end(), [](const std::string& n) {
                         return n.ends_with(".mtl") || n.ends_with(".MTL");
                       }) > 1;
  if (!several) return missing(line);
  for (const std::string& name : names) {
    if (!read(name)) missing(name);
  }
}

class Translator {
 public:
  Translator(ObjTextures& textures, Scene& scene, Warnings& warnings)
      : textures_(textures), scene_(scene), warnings_(warnings) {}

  Material material(const tinyobj::material_t& in) {
    Material m;
    m.name = in.name;
    m.baseColor = colour(in.diffuse, "Kd", 1);
    if (isBlack(m.baseColor) && !in.diffuse_texname.empty()) m.baseColor = Vec3(1);  // "no factor" of some exporters
    m.baseColorTexture =
        reference(textures_.colourWithAlpha(in.diffuse_texname, in.alpha_texname, wrapOf(in.diffuse_texopt), scene_),
                  in.diffuse_texopt);
    if (m.baseColorTexture.texture < 0 && !in.diffuse_texname.empty()) m.baseColor = colourWithoutPicture(m.baseColor);
    m.alpha = limited(in.dissolve, 0, 1, "d");
    m.alphaMode = m.alpha < 1 || !in.alpha_texname.empty() ? AlphaMode::Blend : AlphaMode::Opaque;
    m.emission = colour(in.emission, "Ke", kBrightest);
    m.emissionTexture = reference(
        textures_.colourWithAlpha(in.emissive_texname, "", wrapOf(in.emissive_texopt), scene_), in.emissive_texopt);
    if (isBlack(m.emission) && m.emissionTexture.texture >= 0) m.emission = Vec3(1);
    m.normalTexture =
        reference(textures_.colourWithAlpha(in.normal_texname, "", wrapOf(in.normal_texopt), scene_), in.normal_texopt);
    m.doubleSided = true;  // OBJ knows no one-sided surfaces
    surface(in, m);
    countIgnored(in);
    return m;
  }

 private:
  void surface(const tinyobj::material_t& in, Material& m) {
    m.metallic = limited(in.metallic, 0, 1, "Pm");
    m.roughness = limited(in.roughness, 0, 1, "Pr");
    const std::string &metallic = in.metallic_texname, &roughness = in.roughness_texname;
    const auto& options = metallic.empty() ? in.roughness_texopt : in.metallic_texopt;
    m.metallicRoughnessTexture =
        reference(textures_.metallicRoughness(metallic, roughness, wrapOf(options), scene_), options);
    if (m.metallicRoughnessTexture.texture >= 0) {
      if (!metallic.empty() && m.metallic == 0) m.metallic = 1;
      if (!roughness.empty() && m.roughness == 0) m.roughness = 1;
    }
    if (m.roughness == 0) {
      // Blinn-Phong's exponent as GGX: alpha^2 = 2 / (Ns + 2) (Walter et al. 2007), alpha = roughness^2.
      m.roughness = std::pow(2 / (limited(in.shininess, 0, 1e6f, "Ns") + 2), 0.25f);
    }
    const bool physical = in.roughness > 0 || in.metallic > 0 || m.metallicRoughnessTexture.texture >= 0;
    if (!physical && in.specular[0] <= 0 && in.specular[1] <= 0 && in.specular[2] <= 0) m.specular = 0;
    if (in.ior > 1.01f && in.ior < 4) m.ior = in.ior;
  }

  float limited(float v, float low, float high, const char* key) {
    if (!std::isfinite(v)) {
      warnings_.mended(
          fmt::format("{} of a material is not a finite number and taken as {}", key, high < 2 ? high : 0));
      return high < 2 ? high : 0;
    }
    if (v < low || v > high)
      warnings_.mended(fmt::format("{} of a material is outside {} to {} and limited", key, low, high));
    return std::clamp(v, low, high);
  }
  Vec3 colour(const float (&v)[3], const char* key, float high) {
    return {limited(v[0], 0, high, key), limited(v[1], 0, high, key), limited(v[2], 0, high, key)};
  }

  static Wrap wrapOf(const tinyobj::texture_option_t& options) {
    return options.clamp ? Wrap::ClampToEdge : Wrap::Repeat;
  }

  // OBJ's v points up, the scene's down: v' = s v + o becomes s v + 1 - s - o.
  TextureRef reference(int texture, const tinyobj::texture_option_t& options) {
    TextureRef ref;
    ref.texture = texture;
    const float su = limited(options.scale[0], -1e6f, 1e6f, "-s"), sv = limited(options.scale[1], -1e6f, 1e6f, "-s");
    const float ou = limited(options.origin_offset[0], -1e6f, 1e6f, "-o"),
                ov = limited(options.origin_offset[1], -1e6f, 1e6f, "-o");
    ref.m[0][0] = su, ref.m[0][2] = ou;
    ref.m[1][1] = sv, ref.m[1][2] = 1 - sv - ov;
    return ref;
  }

  void countIgnored(const tinyobj::material_t& in) {
    const auto ignore = [&](const std::string& picture, const char* what) {
      if (!picture.empty()) warnings_.add(fmt::format("{} of MTL files are ignored", what));
    };
    ignore(in.bump_texname, "bump maps (map_bump; heights, use norm)");
    ignore(in.displacement_texname, "displacement maps (disp)");
    ignore(in.specular_texname, "specular maps (map_Ks)");
    ignore(in.specular_highlight_texname, "shininess maps (map_Ns)");
    ignore(in.reflection_texname, "reflection maps (refl)");
  }

  ObjTextures& textures_;
  Scene& scene_;
  Warnings& warnings_;
};

std::set<std::string> picturesOf(const std::vector<const tinyobj::material_t*>& used) {
  std::set<std::string> names;
  for (const tinyobj::material_t* m : used) {
    if (!m) continue;
    for (const std::string* name : {&m->diffuse_texname, &m->alpha_texname, &m->emissive_texname, &m->normal_texname,
                                    &m->metallic_texname, &m->roughness_texname}) {
      if (!name->empty()) names.insert(*name);
    }
  }
  return names;
}

}  // namespace

void addObjMaterials(const ReadCompanion& companions, const std::vector<std::string>& libraries,
                     const std::vector<std::string>& names, Scene& scene, Warnings& warnings) {
  Libraries read;
  for (const std::string& library : libraries) readLibraries(companions, library, read, warnings);
  std::vector<const tinyobj::material_t*> used;
  for (const std::string& name : names) {
    const auto it = read.indices.find(name);
    used.push_back(name.empty() || it == read.indices.end() ? nullptr
                                                            : &read.materials[static_cast<size_t>(it->second)]);
    if (!name.empty() && !used.back()) warnings.add("materials that no MTL file holds are grey");
  }
  ObjTextures textures(companions, picturesOf(used), warnings);
  Translator translator(textures, scene, warnings);
  for (size_t i = 0; i < names.size(); ++i) {
    Material grey = greyMaterial(names[i].empty() ? "default" : names[i]);
    grey.doubleSided = true;
    scene.materials.push_back(used[i] ? translator.material(*used[i]) : grey);
  }
}

}  // namespace roomlight::importers
