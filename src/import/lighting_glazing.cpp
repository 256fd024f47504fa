#include "import/lighting_glazing.h"

#include <fmt/format.h>

#include <algorithm>

#include "import/printable.h"
#include "scene/surface.h"

namespace roomlight {
namespace {

constexpr size_t kMostGlazings = 1000;
constexpr double kClearGlassIor = 1.52, kSixMillimetres = 0.96;  // of clear float glass

}  // namespace

std::vector<GlazedMaterial> readGlazing(const JsonPlace& j) {
  std::vector<GlazedMaterial> out;
  const size_t count = j.arraySize();
  if (count > kMostGlazings) j.fail(fmt::format("more than {} kinds of glazing", kMostGlazings));
  for (size_t i = 0; i < std::min(count, kMostGlazings); ++i) {
    const JsonPlace one = j[i];
    if (!one.isObject({"material", "panes", "ior", "internalTransmittance"})) return out;
    const double panes = one.number("panes", 1, kMostGlazingPanes, 1);
    if (panes != static_cast<int>(panes)) one["panes"].fail("must be a whole number");
    const double ior = one.number("ior", 1, 4, kClearGlassIor),
                 internal = one.number("internalTransmittance", 0.001, 1, kSixMillimetres);
    out.push_back(
        {one["material"].text(), {static_cast<int>(panes), static_cast<float>(ior), static_cast<float>(internal)}});
  }
  return out;
}

std::string missingMaterial(const std::vector<GlazedMaterial>& glazing, const Scene& scene) {
  for (size_t i = 0; i < glazing.size(); ++i) {
    const auto called = [&](const Material& m) { return m.name == glazing[i].material; };
    if (std::any_of(scene.materials.begin(), scene.materials.end(), called)) continue;
    std::string names;
    for (const Material& m : scene.materials) names += (names.empty() ? "'" : ", '") + m.name + "'";
    return fmt::format("glazing[{}].material: no material is called '{}'; there are {}", i,
                       printable(glazing[i].material, 60), printable(names, 400));
  }
  return {};
}

void applyGlazing(const std::vector<GlazedMaterial>& glazing, Scene& scene) {
  for (const GlazedMaterial& g : glazing) {
    for (Material& m : scene.materials) {
      if (m.name == g.material) glaze(m, g.glazing);
    }
  }
}

}  // namespace roomlight
