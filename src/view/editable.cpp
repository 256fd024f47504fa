#include "view/editable.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "photometry/colour_temperature.h"
#include "scene/scene_lamps.h"
#include "scene/shown_names.h"

namespace roomlight::view {
namespace {

// Above this many triangles, meshes that things share stay shared: parting them would need too much memory.
constexpr size_t kMostToPart = 6'000'000;
// What stands still: as long as a room, or as high as a door and thin like a wall.
constexpr float kLongM = 4, kHighM = 1.9f, kThinM = 0.45f;

const Material& materialOf(const Scene& scene, const Instance& instance) {
  return scene.materials[static_cast<size_t>(scene.meshes[static_cast<size_t>(instance.mesh)].material)];
}

bool isRoom(const Scene& scene, const std::string& name) {
  return std::any_of(scene.rooms.begin(), scene.rooms.end(), [&](const Room& r) { return r.name == name; });
}

bool standsStill(const Scene& scene, const EditableObject& o) {
  const Vec3 size = o.bounds.size();
  const float longest = std::max(size.x, size.z), thin = std::min(size.x, size.z);
  return longest > kLongM || (size.y > kHighM && thin < kThinM) || isRoom(scene, o.name) || o.name == "ground";
}

std::optional<Leaf> leafOf(const Scene& scene, const Instance& instance) {
  if (instance.leaf < 0) return {};
  return scene.leaves[static_cast<size_t>(instance.leaf)];
}

// The mean is strictly between shut and wide open where the leaves differ, so that from there all of them can go either
// way.
void findOpening(EditableObject& o) {
  float sum = 0, count = 0;
  for (const EditableObject::Part& part : o.parts) {
    if (part.leaf) sum += part.leaf->atRest, ++count;
  }
  o.opens = count > 0;
  if (o.opens) o.openAtRest = sum / count;
}

// Numbers of the scene's objects -> those of the list.
std::map<int, int> findObjects(const Scene& scene, bool parted, EditableHome& home) {
  std::map<int, int> numbers;
  std::vector<std::set<size_t>> materials;
  const std::map<int, std::string> shown = shownObjectNames(scene);
  for (uint32_t i = 0; i < scene.instances.size(); ++i) {
    const Instance& instance = scene.instances[i];
    const Bounds3 bounds = instanceBounds(scene, instance);
    if (bounds.empty()) continue;
    const auto [number, isNew] = numbers.try_emplace(instance.object, static_cast<int>(home.objects.size()));
    if (isNew) home.objects.emplace_back(), materials.emplace_back();
    const auto k = static_cast<size_t>(number->second);
    EditableObject& object = home.objects[k];
    if (isNew) object.name = instance.name, object.label = shown.at(instance.object);
    object.parts.push_back({i, instance.worldFromObject, instance.mesh, bounds, leafOf(scene, instance)});
    object.bounds.add(bounds);
    const auto material = static_cast<size_t>(scene.meshes[static_cast<size_t>(instance.mesh)].material);
    if (parted && !shines(scene, instance) && materials[k].insert(material).second)
      object.paints.push_back({material, scene.materials[material].baseColor});
  }
  for (EditableObject& o : home.objects) o.movable = !standsStill(scene, o), findOpening(o);
  return numbers;
}

Vec3 lightOf(const Lamp& lamp) { return lamp.kind == LampKind::Area ? lamp.luminanceCdM2 : lamp.intensityCd; }

const char* kindOf(const Lamp& lamp) {
  if (lamp.kind == LampKind::Spot) return "spot";
  if (lamp.kind == LampKind::Area) return "area";
  return lamp.web ? "photometric" : "point";
}

double areaM2(const Mesh& mesh, const Affine& m) {
  double sum = 0;
  for (size_t t = 0; t + 2 < mesh.indices.size(); t += 3) {
    const Vec3 a = m.point(mesh.positions[mesh.indices[t]]), b = m.point(mesh.positions[mesh.indices[t + 1]]),
               c = m.point(mesh.positions[mesh.indices[t + 2]]);
    sum += 0.5 * static_cast<double>(length(cross(b - a, c - a)));
  }
  return sum;
}

// Blue over red grows with the temperature; colours that are not a black body's have none.
std::optional<float> temperatureOf(Vec3 color) {
  double low = kLowestKelvin, high = kHighestKelvin;
  for (int i = 0; i < 40; ++i) {
    const double middle = std::sqrt(low * high);
    const Vec3 c = blackBodyColour(middle);
    (c.z * color.x < color.z * c.x ? low : high) = middle;
  }
  const double kelvin = std::round(std::sqrt(low * high) / 10) * 10;
  if (maxComponent(abs(blackBodyColour(kelvin) - color)) > 0.02f) return {};
  return static_cast<float>(kelvin);
}

// What shines without a lamp: its place, light and flux. The flux is 0 where a texture decides it.
Vec3 measureGlow(const Scene& scene, EditableLamp& l) {
  Bounds3 bounds;
  Vec3 light;
  bool textured = false;
  for (const uint32_t i : l.instances) {
    const Instance& instance = scene.instances[i];
    const Material& m = materialOf(scene, instance);
    bounds.add(instanceBounds(scene, instance));
    const double area =
        areaM2(scene.meshes[static_cast<size_t>(instance.mesh)], instance.worldFromObject) * (m.doubleSided ? 2 : 1);
    l.fluxLm += std::numbers::pi * area * static_cast<double>(luminance(m.emission));
    light += m.emission * static_cast<float>(area);
    textured = textured || m.emissionTexture.texture >= 0;
  }
  l.position = bounds.centre();
  if (textured) l.fluxLm = 0;
  return light;
}

EditableLamp editableLamp(const Scene& scene, const SceneLamp& from, const std::map<int, int>& objects,
                          EditableHome& home) {
  EditableLamp l;
  l.name = from.name, l.instances = from.instances;
  if (from.object >= 0) l.object = objects.at(from.object);
  for (const size_t i : from.lamps) l.sources.push_back({i, scene.lamps[i]});
  std::set<size_t> materials;
  for (const uint32_t i : from.instances) {
    const auto m = static_cast<size_t>(scene.meshes[static_cast<size_t>(scene.instances[i].mesh)].material);
    if (materials.insert(m).second) l.glows.push_back({m, scene.materials[m].emission});
    if (from.object < 0) home.objects[static_cast<size_t>(objects.at(scene.instances[i].object))].lampBody = true;
  }
  Vec3 light;
  if (l.sources.empty()) {
    l.kind = "glow";
    light = measureGlow(scene, l);
  } else {
    const Lamp& first = l.sources[0].full;
    l.kind = kindOf(first), l.position = first.position, l.direction = first.direction;
    l.aimed = l.object < 0 && l.kind != "point";
    for (const EditableLamp::Source& s : l.sources) l.fluxLm += lampFluxLm(s.full), light += lightOf(s.full);
  }
  const float lum = luminance(light);
  if (lum > 0) l.color = light / lum;
  l.temperatureK = temperatureOf(l.color);
  return l;
}

}  // namespace

EditableHome makeEditable(Scene& scene) {
  EditableHome home;
  const bool parted = scene.triangleCount() <= kMostToPart;
  if (parted) partMaterials(scene);
  const std::map<int, int> objects = findObjects(scene, parted, home);
  const std::vector<SceneLamp> lamps = findLamps(scene);
  for (const SceneLamp& l : lamps) home.lamps.push_back(editableLamp(scene, l, objects, home));
  const std::vector<std::string> shown = shownLampNames(scene, lamps);
  for (size_t i = 0; i < shown.size(); ++i) home.lamps[i].label = shown[i];
  home.hiddenMesh = static_cast<int>(scene.meshes.size());
  scene.meshes.emplace_back();
  for (const EditableLamp& l : home.lamps) {
    LampState& s = home.atStart.lamps.emplace_back();
    s.position = l.position, s.direction = l.direction, s.fluxLm = l.fluxLm;
  }
  for (const EditableObject& o : home.objects) {
    ObjectState& s = home.atStart.objects.emplace_back();
    s.open = o.openAtRest;
    for (const EditableObject::Paint& p : o.paints) s.colors.push_back(p.color);
  }
  return home;
}

}  // namespace roomlight::view
