#include "view/off_lamps.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "home/light.h"
#include "scene/scene_lamps.h"

namespace roomlight::view {
namespace {

using nlohmann::json;

constexpr float kSamePlaceM = 1e-3f;

KindsOff kindsOff(const json& document) {
  KindsOff off;
  if (!document.is_object() || !document.contains("scene") || !document["scene"].is_object()) return off;
  const json &scene = document["scene"], emission = scene.value("emission", json("keep"));
  off.lamps = scene.value("lamps", json("keep")) == "off";
  off.emission = emission == "off" || (emission.is_number() && emission.get<double>() == 0);
  return off;
}

size_t materialOf(const Scene& scene, const Instance& instance) {
  return static_cast<size_t>(scene.meshes[static_cast<size_t>(instance.mesh)].material);
}

bool isApart(const Lamp& lamp) { return lamp.kind != LampKind::Area; }  // else its rectangle shines

// Puts the home's own light into the scene again, of those kinds.
OffLamps broughtBack(const home::LightBefore& before, size_t fileLamps, KindsOff kinds, Scene& scene) {
  OffLamps off;
  off.kinds = kinds;
  if (kinds.lamps) {
    std::vector<Lamp> lamps = before.lamps;
    lamps.insert(lamps.end(), scene.lamps.end() - static_cast<std::ptrdiff_t>(fileLamps), scene.lamps.end());
    scene.lamps = std::move(lamps);
  }
  off.lamps.resize(scene.lamps.size()), off.instances.resize(scene.instances.size());
  for (size_t i = 0; kinds.lamps && i < before.lamps.size(); ++i)
    off.lamps[i] = isApart(before.lamps[i]) && !isBlack(before.lamps[i].intensityCd);
  if (!kinds.emission) return off;
  std::vector<uint8_t> back(scene.materials.size(), 0);
  for (size_t m = 0; m < before.emission.size(); ++m) {
    back[m] = isBlack(scene.materials[m].emission) && !isBlack(before.emission[m]);
    if (back[m]) scene.materials[m].emission = before.emission[m];
  }
  for (size_t i = 0; i < scene.instances.size(); ++i) off.instances[i] = back[materialOf(scene, scene.instances[i])];
  return off;
}

// The kinds without those that would leave a lamp half on and half off.
KindsOff wholeKinds(const Scene& scene, const OffLamps& off) {
  KindsOff kinds = off.kinds;
  for (const SceneLamp& lamp : findLamps(scene)) {
    bool shines = false, hasLamp = false, hasGlow = false;
    for (const size_t i : lamp.lamps) {
      hasLamp = hasLamp || off.lamps[i];
      shines = shines || (!off.lamps[i] && isApart(scene.lamps[i]) && !isBlack(scene.lamps[i].intensityCd));
    }
    for (const uint32_t i : lamp.instances) (off.instances[i] ? hasGlow : shines) = true;
    kinds.lamps = kinds.lamps && !(shines && hasLamp);
    kinds.emission = kinds.emission && !(shines && hasGlow);
  }
  return kinds;
}

OffLamps bringBackOwn(const home::LightBefore& before, const LightingSource& source, Scene& scene) {
  const std::vector<Lamp> lamps = scene.lamps;
  std::vector<Vec3> emission;
  for (const Material& m : scene.materials) emission.push_back(m.emission);
  for (KindsOff kinds = kindsOff(source.document);;) {
    OffLamps off = broughtBack(before, source.lamps, kinds, scene);
    if (kinds == KindsOff()) return off;
    const KindsOff whole = wholeKinds(scene, off);
    if (whole == kinds) return off;
    kinds = whole;
    scene.lamps = lamps;
    for (size_t m = 0; m < emission.size(); ++m) scene.materials[m].emission = emission[m];
  }
}

json entryOf(const Lamp& lamp) {
  const Vec3 color = lamp.intensityCd / luminance(lamp.intensityCd);
  return {{"name", lamp.name},
          {"type", "point"},
          {"position", {lamp.position.x, lamp.position.y, lamp.position.z}},
          {"flux", fmt::format("{:.6g} lm", lampFluxLm(lamp))},
          {"color", {color.x, color.y, color.z}},
          {"dimming", 0}};
}

// A lamp of the lighting file that stands for one of the home: it was saved so.
bool isInFile(const Scene& scene, size_t firstOfFile, const Lamp& lamp) {
  return std::any_of(
      scene.lamps.begin() + static_cast<std::ptrdiff_t>(firstOfFile), scene.lamps.end(),
      [&](const Lamp& l) { return l.name == lamp.name && length(l.position - lamp.position) < kSamePlaceM; });
}

// But for those that would be a part of another lamp, which is not off.
void addHomesOff(const std::vector<Lamp>& lamps, LightingSource& source, Scene& scene, OffLamps& off) {
  const size_t firstOfFile = scene.lamps.size() - source.lamps, first = scene.lamps.size();
  for (const Lamp& lamp : lamps) {
    if (!isInFile(scene, firstOfFile, lamp)) scene.lamps.push_back(lamp);
  }
  if (scene.lamps.size() == first) return;
  std::vector<uint8_t> isPart(scene.lamps.size(), 0);
  for (const SceneLamp& l : findLamps(scene)) {
    const bool apart =
        l.instances.empty() && std::all_of(l.lamps.begin(), l.lamps.end(), [&](size_t i) { return i >= first; });
    for (const size_t i : l.lamps) isPart[i] = !apart;
  }
  if (!source.document.is_object()) source.document = {{"version", 1}};
  for (size_t i = first, next = first; next < isPart.size(); ++next) {
    if (isPart[next]) {
      scene.lamps.erase(scene.lamps.begin() + static_cast<std::ptrdiff_t>(i));
      continue;
    }
    source.document["lamps"].push_back(entryOf(scene.lamps[i++]));
    off.lamps.push_back(0), off.assumed.push_back(1), ++source.lamps;
  }
}

// What has no light at all is taken for a lamp that is off.
void giveAssumedLight(LightingSource& source, Scene& scene, OffLamps& off) {
  const size_t first = scene.lamps.size() - source.lamps;
  const auto isDark = [&](size_t i) { return isApart(scene.lamps[i]) && isBlack(scene.lamps[i].intensityCd); };
  bool any = false;
  for (size_t i = 0; i < scene.lamps.size(); ++i) any = any || isDark(i);
  if (!any) return;
  for (const SceneLamp& lamp : findLamps(scene)) {
    if (!lamp.instances.empty() || !std::all_of(lamp.lamps.begin(), lamp.lamps.end(), isDark)) continue;
    const double lm =
        home::assumedFluxLm(scene.rooms, scene.lamps[lamp.lamps[0]].position) / static_cast<double>(lamp.lamps.size());
    for (const size_t i : lamp.lamps) {
      setLampFlux(scene.lamps[i], lm), off.assumed[i] = 1;
      if (i < first) continue;
      json& entry = source.document["lamps"][i - first];
      entry.erase("intensity"), entry.erase("lightLossFactor");
      entry["flux"] = fmt::format("{:.6g} lm", lm), entry["dimming"] = 0;
    }
  }
}

}  // namespace

OffLamps bringBackLamps(home::OpenedHome& opened, LightingSource& source) {
  OffLamps off = bringBackOwn(opened.before, source, opened.scene);
  off.assumed.resize(opened.scene.lamps.size());
  giveAssumedLight(source, opened.scene, off);
  addHomesOff(opened.offLamps, source, opened.scene, off);
  return off;
}

void markOff(const OffLamps& off, ViewHome& home) {
  home.lighting.off = off.kinds;
  home.lighting.keptOff.clear();
  for (EditableLamp& lamp : home.editable.lamps) {
    const auto isOf = [&](const std::vector<uint8_t>& list) {
      return std::any_of(lamp.sources.begin(), lamp.sources.end(), [&](const auto& s) { return list[s.lamp] != 0; });
    };
    home.lighting.keptOff.push_back(isOf(off.lamps) || std::any_of(lamp.instances.begin(), lamp.instances.end(),
                                                                   [&](uint32_t i) { return off.instances[i] != 0; }));
    lamp.fluxAssumed = isOf(off.assumed);
  }
}

}  // namespace roomlight::view
