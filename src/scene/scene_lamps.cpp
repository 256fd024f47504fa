#include "scene/scene_lamps.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <string_view>

#include "photometry/spot.h"

namespace roomlight {
namespace {

constexpr float kNearM = 0.1f;  // a lamp so near to a thing of its name is part of it

std::string lampName(const Instance& i) {
  return i.name.ends_with(kLightSuffix) ? i.name.substr(0, i.name.size() - std::string_view(kLightSuffix).size())
                                        : i.name;
}

struct Thing {
  std::string name;
  Bounds3 bounds;
};
std::map<int, Thing> thingsOf(const Scene& scene) {
  std::map<int, Thing> things;
  for (const Instance& i : scene.instances) {
    const Bounds3 bounds = instanceBounds(scene, i);
    if (bounds.empty()) continue;
    const auto [thing, isNew] = things.try_emplace(i.object, Thing{i.name, {}});
    thing->second.bounds.add(bounds);
  }
  return things;
}

// The rectangle that addAreaLampMeshes() made of the lamp.
bool isBodyOf(const Scene& scene, const Lamp& lamp, const Instance& instance) {
  if (lamp.kind != LampKind::Area || instance.name != lamp.name || !shines(scene, instance)) return false;
  return length(instanceBounds(scene, instance).centre() - lamp.position) < 1e-3f * (1 + length(lamp.position));
}

class Finder {
 public:
  explicit Finder(const Scene& scene) : scene_(scene), things_(thingsOf(scene)), taken_(scene.instances.size(), 0) {}

  std::vector<SceneLamp> find() {
    for (size_t i = 0; i < scene_.lamps.size(); ++i) addLamp(i);
    for (uint32_t i = 0; i < scene_.instances.size(); ++i) {
      const Instance& instance = scene_.instances[i];
      if (!taken_[i] && shines(scene_, instance) && things_.count(instance.object))
        lampOf(instance.object, lampName(instance)).instances.push_back(i);
    }
    return std::move(found_);
  }

 private:
  SceneLamp& lampOf(int object, const std::string& name) {
    if (object >= 0) {
      const auto [known, isNew] = byThing_.try_emplace({object, name}, found_.size());
      if (!isNew) return found_[known->second];
    }
    found_.push_back({name, object, {}, {}});
    return found_.back();
  }
  int thingAround(const Lamp& lamp) const {
    for (const auto& [number, thing] : things_) {
      if (thing.name == lamp.name &&
          minComponent(min(lamp.position - thing.bounds.lo, thing.bounds.hi - lamp.position)) > -kNearM)
        return number;
    }
    return -1;
  }
  void addLamp(size_t i) {
    const Lamp& lamp = scene_.lamps[i];
    const bool area = lamp.kind == LampKind::Area;
    SceneLamp& to = lampOf(area ? -1 : thingAround(lamp), lamp.name);
    to.lamps.push_back(i);
    for (uint32_t k = 0; area && k < scene_.instances.size(); ++k) {
      if (taken_[k] || !isBodyOf(scene_, lamp, scene_.instances[k])) continue;
      taken_[k] = 1;
      to.instances.push_back(k);
      return;
    }
  }

  const Scene& scene_;
  const std::map<int, Thing> things_;
  std::vector<uint8_t> taken_;  // instances that are the bodies of lamps
  std::vector<SceneLamp> found_;
  std::map<std::pair<int, std::string>, size_t> byThing_;
};

}  // namespace

bool shines(const Scene& scene, const Instance& instance) {
  return !isBlack(
      scene.materials[static_cast<size_t>(scene.meshes[static_cast<size_t>(instance.mesh)].material)].emission);
}

double lampFluxLm(const Lamp& lamp) {
  const double cd = static_cast<double>(luminance(lamp.intensityCd));
  if (lamp.kind == LampKind::Area)
    return std::numbers::pi * static_cast<double>(luminance(lamp.luminanceCdM2) * lamp.widthM * lamp.heightM);
  if (lamp.kind == LampKind::Spot)
    return cd * spotFluxPerCandela(std::cos(lamp.innerConeRad), std::cos(lamp.outerConeRad));
  if (lamp.web) return lamp.web->peakCd > 0 ? cd * lamp.web->fluxLm / static_cast<double>(lamp.web->peakCd) : 0;
  return 4 * std::numbers::pi * cd;
}

void setLampFlux(Lamp& lamp, double fluxLm) {
  Vec3& light = lamp.kind == LampKind::Area ? lamp.luminanceCdM2 : lamp.intensityCd;
  if (!(luminance(light) > 0)) light = Vec3(1);
  const double now = lampFluxLm(lamp);
  light *= now > 0 ? static_cast<float>(fluxLm / now) : 0;
}

std::vector<SceneLamp> findLamps(const Scene& scene) { return Finder(scene).find(); }

void partMaterials(Scene& scene) {
  using Owner = std::pair<int, std::string>;  // the thing, and whether a part shines as this lamp
  std::map<std::pair<int, Owner>, int> copies;    // of materials
  std::map<std::pair<int, int>, int> meshCopies;  // (mesh, material)
  std::set<int> takenMaterials, takenMeshes;
  // Meshes are copied before their material is replaced: their own is asked for by later instances.
  std::vector<int> materialOfMesh;
  for (const Mesh& mesh : scene.meshes) materialOfMesh.push_back(mesh.material);
  for (Instance& i : scene.instances) {
    const int mesh = i.mesh, material = materialOfMesh[static_cast<size_t>(mesh)];
    const bool shining = !isBlack(scene.materials[static_cast<size_t>(material)].emission);
    const Owner owner{i.object, shining ? lampName(i) : std::string()};
    const auto [copy, isNew] = copies.try_emplace({material, owner}, material);
    if (isNew && !takenMaterials.insert(material).second) {
      copy->second = static_cast<int>(scene.materials.size());
      scene.materials.push_back(Material(scene.materials[static_cast<size_t>(material)]));
    }
    const auto [meshCopy, meshIsNew] = meshCopies.try_emplace({mesh, copy->second}, mesh);
    if (meshIsNew && !takenMeshes.insert(mesh).second) {
      meshCopy->second = static_cast<int>(scene.meshes.size());
      scene.meshes.push_back(Mesh(scene.meshes[static_cast<size_t>(mesh)]));
    }
    i.mesh = meshCopy->second;
    scene.meshes[static_cast<size_t>(i.mesh)].material = copy->second;
  }
}

}  // namespace roomlight
