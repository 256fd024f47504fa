#include "scene/shown_names.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string_view>

namespace roomlight {
namespace {

bool isDigit(char c) { return c >= '0' && c <= '9'; }
bool isUpper(char c) { return c >= 'A' && c <= 'Z'; }
bool isLetter(char c) { return isUpper(c) || (c >= 'a' && c <= 'z') || static_cast<unsigned char>(c) >= 0x80; }

// Blender ends the names of copies so.
std::string withoutNumber(const std::string& name) {
  const size_t dot = name.rfind('.');
  if (dot == std::string::npos || dot == 0 || name.size() - dot < 4) return name;
  return std::all_of(name.begin() + static_cast<std::ptrdiff_t>(dot) + 1, name.end(), isDigit) ? name.substr(0, dot)
                                                                                               : name;
}

// What programs call materials that nobody named.
bool isFiller(std::string_view word) {
  static constexpr std::array kFillers = {
      "material", "mat",  "mtl",    "default", "color", "colour",   "front",    "back",
      "wire",     "mesh", "shader", "lambert", "phong", "blinn",    "initial",  "shading",
      "group",    "auto", "object", "obj",     "none",  "unnamed",  "untitled", "scene",
      "root",     "node", "new",    "texture", "tex",   "standard", "std",      "principled",
      "bsdf",     "no",   "name",   "surface", "part",  "id",       "sg",       "initialshadinggroup"};
  return std::any_of(kFillers.begin(), kFillers.end(), [&](const char* f) { return word == f; });
}

// Whether it has no word that tells anything: "wire_204204204", "Material.001", "lambert2SG".
bool isCode(const std::string& name) {
  std::string word;
  const auto tells = [&] {
    const bool so = word.size() >= 3 && !isFiller(word);
    word.clear();
    return so;
  };
  for (size_t i = 0; i < name.size(); ++i) {
    const char c = name[i];
    const bool begins = isUpper(c) && i > 0 && !isUpper(name[i - 1]);  // "FrontColor"
    if ((!isLetter(c) || begins) && tells()) return false;
    if (isLetter(c)) word.push_back(isUpper(c) ? static_cast<char>(c - 'A' + 'a') : c);
  }
  return !tells();
}

// As people see colours: lightness 0 to 1, chroma, hue in degrees (OKLab, Ottosson 2020).
struct Seen {
  float lightness, chroma, hueDeg;
};
Seen seen(Vec3 c) {
  const float l = std::cbrt(0.4122214708f * c.x + 0.5363325363f * c.y + 0.0514459929f * c.z),
              m = std::cbrt(0.2119034982f * c.x + 0.6806995451f * c.y + 0.1073969566f * c.z),
              s = std::cbrt(0.0883024619f * c.x + 0.2817188376f * c.y + 0.6299787005f * c.z);
  const float a = 1.9779984951f * l - 2.4285922050f * m + 0.4505937099f * s,
              b = 0.0259040371f * l + 0.7827717662f * m - 0.8086757660f * s;
  const float hue = std::atan2(b, a) * 180 / std::numbers::pi_v<float>;
  return {0.2104542553f * l + 0.7936177850f * m - 0.0040720468f * s, std::hypot(a, b), hue < 0 ? hue + 360 : hue};
}

// Of oranges and yellows that are pale or dark, which have names of their own; empty: of none of these.
std::string earthTone(const Seen& c) {
  if (c.hueDeg < 42 || c.hueDeg >= 118) return {};
  const bool orange = c.hueDeg < 75;
  if (c.lightness < (orange ? 0.66f : 0.6f)) {
    const std::string name = c.hueDeg < 100 ? "brown" : "olive";
    return (c.lightness < 0.38f ? "dark " : "") + name;
  }
  if (c.chroma >= 0.1f) return {};
  return c.lightness >= 0.9f ? "cream" : c.lightness >= 0.72f ? "beige" : "light brown";
}

std::string hueInWords(const Seen& c) {
  struct Hue {
    float upToDeg;
    const char* name;
  };
  static constexpr std::array kHues = {Hue{15, "pink"},    Hue{42, "red"},     Hue{75, "orange"},
                                       Hue{118, "yellow"}, Hue{168, "green"},  Hue{215, "turquoise"},
                                       Hue{285, "blue"},   Hue{322, "purple"}, Hue{361, "pink"}};
  const auto hue = std::find_if(kHues.begin(), kHues.end(), [&](const Hue& h) { return c.hueDeg < h.upToDeg; });
  const std::string name = hue->name;
  if (name == "red" && c.lightness >= 0.75f) return "pink";
  if (name == "pink" && c.lightness < 0.45f) return "dark red";
  return (c.lightness >= 0.82f && name != "yellow" ? "light " : c.lightness < 0.45f ? "dark " : "") + name;
}

bool isEven(const Material& m) {
  return m.baseColorTexture.texture < 0 && m.alphaMode == AlphaMode::Opaque && m.transmission == 0 &&
         m.glazing.panes == 0 && m.emissionTexture.texture < 0 && isBlack(m.emission);
}

}  // namespace

std::vector<std::string> withoutCopyNumbers(std::vector<std::string> names) {
  std::vector<std::string> plain;
  std::map<std::string, size_t> counts;
  for (const std::string& name : names) ++counts[plain.emplace_back(withoutNumber(name))];
  for (size_t i = 0; i < names.size(); ++i) {
    if (counts[plain[i]] == 1) names[i] = plain[i];
  }
  return names;
}

std::map<int, std::string> shownObjectNames(const Scene& scene) {
  std::map<int, std::string> shown;
  for (const Instance& i : scene.instances) shown.try_emplace(i.object, i.label.empty() ? i.name : i.label);
  std::vector<std::string> names;
  for (const auto& [object, name] : shown) names.push_back(name);
  names = withoutCopyNumbers(std::move(names));
  size_t next = 0;
  for (auto& [object, name] : shown) name = names[next++];
  return shown;
}

std::vector<std::string> shownLampNames(const Scene& scene, const std::vector<SceneLamp>& lamps) {
  const std::map<int, std::string> things = shownObjectNames(scene);
  std::map<int, const std::string*> called;
  for (const Instance& i : scene.instances) called.try_emplace(i.object, &i.name);
  std::vector<std::string> names;
  for (const SceneLamp& l : lamps) names.push_back(l.name);
  names = withoutCopyNumbers(std::move(names));
  for (size_t i = 0; i < lamps.size(); ++i) {
    const auto thing = called.find(lamps[i].object);
    if (thing != called.end() && *thing->second == lamps[i].name) names[i] = things.at(thing->first);
  }
  return names;
}

std::string shownMaterialName(const Material& m, Vec3 baseColor) {
  const bool even = isEven(m), metal = m.metallic >= 0.5f;
  if (!m.label.empty()) return even && !metal ? colourInWords(baseColor) + " " + m.label : m.label;
  if (!isCode(m.name)) return m.name;
  if (m.transmission > 0 || m.glazing.panes > 0) return "glass";
  if (!even || (metal && m.metallicRoughnessTexture.texture >= 0)) return m.name;
  return colourInWords(baseColor) + (metal ? " metal" : "");
}

std::string colourInWords(Vec3 reflectance) {
  constexpr float kLeastChroma = 0.03f, kBlack = 0.28f;
  const Seen c = seen(max(reflectance, Vec3(0)));
  if (c.lightness < kBlack && c.chroma < 2 * kLeastChroma) return "black";
  if (c.chroma < kLeastChroma) {
    if (c.lightness >= 0.92f) return "white";
    return c.lightness >= 0.76f ? "light grey" : c.lightness >= 0.48f ? "grey" : "dark grey";
  }
  const std::string earth = earthTone(c);
  return earth.empty() ? hueInWords(c) : earth;
}

}  // namespace roomlight
