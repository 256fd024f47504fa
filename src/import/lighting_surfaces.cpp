#include "import/lighting_surfaces.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/utf8.h"
#include "import/lighting_values.h"
#include "scene/primitives.h"
#include "scene/shown_names.h"
#include "scene/surface.h"

namespace roomlight {
namespace {

constexpr int kCorners = 96;

}  // namespace

Ground readGround(const JsonPlace& j) {
  Ground ground;
  if (!j.isObject({"elevation", "centre", "radius", "reflectance"})) return ground;
  ground.centre.y = static_cast<float>(j["elevation"].number(-kFarthestM, kFarthestM));
  if (j.has("centre")) {
    const JsonPlace centre = j["centre"];
    if (!centre.isArray() || centre.arraySize() != 2) {
      centre.fail("must be [x, z]");
    } else {
      ground.centre.x = static_cast<float>(centre[size_t{0}].number(-kFarthestM, kFarthestM));
      ground.centre.z = static_cast<float>(centre[size_t{1}].number(-kFarthestM, kFarthestM));
    }
  }
  ground.radiusM = static_cast<float>(j["radius"].number(1e-3, kFarthestM));
  ground.reflectance = static_cast<float>(j.number("reflectance", 0, 1, 0.2));
  return ground;
}

void addGround(const Ground& ground, Scene& scene) {
  Mesh mesh;
  mesh.name = "Ground";
  mesh.material = addMaterial(scene, lambertian(ground.reflectance));
  scene.materials.back().name = "Ground";
  mesh.positions.push_back(ground.centre);
  for (int i = 0; i < kCorners; ++i) {
    const float angle = 2 * kPi * static_cast<float>(i) / kCorners;
    mesh.positions.push_back(ground.centre + Vec3{std::sin(angle), 0, std::cos(angle)} * ground.radiusM);
  }
  for (uint32_t i = 0; i < kCorners; ++i) mesh.indices.insert(mesh.indices.end(), {0, 1 + i, 1 + (i + 1) % kCorners});
  int object = 0;
  for (const Instance& instance : scene.instances) object = std::max(object, instance.object + 1);
  Instance instance;
  instance.name = mesh.name;
  instance.mesh = static_cast<int>(scene.meshes.size());
  instance.object = object;
  scene.meshes.push_back(std::move(mesh));
  scene.instances.push_back(std::move(instance));
}

namespace {

constexpr size_t kMostGlazings = 1000;
constexpr double kClearGlassIor = 1.52, kSixMillimetres = 0.96;  // of clear float glass

// By its name, or where none has that by what people call it.
std::vector<size_t> materialsCalled(const Scene& scene, const std::string& name) {
  std::vector<size_t> named, shown;
  for (size_t i = 0; i < scene.materials.size(); ++i) {
    if (scene.materials[i].name == name) named.push_back(i);
    if (shownMaterialName(scene.materials[i]) == name) shown.push_back(i);
  }
  return named.empty() ? shown : named;
}

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
    if (!materialsCalled(scene, glazing[i].material).empty()) continue;
    std::string names;
    for (const Material& m : scene.materials) names += (names.empty() ? "'" : ", '") + m.name + "'";
    return fmt::format("glazing[{}].material: no material is called '{}'; there are {}", i,
                       printable(glazing[i].material, 60), printable(names, 400));
  }
  return {};
}

void applyGlazing(const std::vector<GlazedMaterial>& glazing, Scene& scene) {
  std::vector<std::vector<size_t>> called;  // before any of them becomes glass
  for (const GlazedMaterial& g : glazing) called.push_back(materialsCalled(scene, g.material));
  for (size_t k = 0; k < glazing.size(); ++k) {
    for (const size_t i : called[k]) glaze(scene.materials[i], glazing[k].glazing);
  }
}

}  // namespace roomlight
