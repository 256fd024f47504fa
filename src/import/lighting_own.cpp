#include "import/lighting_lamps.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "base/utf8.h"
#include "import/lighting_values.h"
#include "import/photometric_file.h"
#include "photometry/colour_temperature.h"
#include "scene/scene_lamps.h"
#include "scene/shown_names.h"

namespace roomlight {
namespace {

constexpr size_t kMostOwn = 100'000, kMostNames = 40;

OwnLamp readOwn(const JsonPlace& j) {
  OwnLamp own;
  if (!j.isObject({"name", "number", "dimming", "factor", "flux", "temperature", "color", "position", "direction"}))
    return own;
  own.name = j["name"].text();
  const double number = j.number("number", 1, 1e6, 1);
  if (number != std::floor(number)) j["number"].fail("must be a whole number");
  own.number = static_cast<size_t>(number);
  own.dimming = j.number("dimming", 0, 1, 1);
  own.factor = j.number("factor", 0, 1e6, 1);
  if (j.has("flux")) own.fluxLm = j["flux"].quantity(Unit::Lumen, 0, kMostLight);
  if (j.has("flux") && j.has("factor")) j["factor"].fail("beside 'flux', which says the same");
  if (j.has("color") || j.has("temperature")) own.color = readColour(j);
  if (j.has("temperature"))
    own.temperatureK = static_cast<float>(j["temperature"].quantity(Unit::Kelvin, kLowestKelvin, kHighestKelvin));
  if (j.has("position")) own.position = j["position"].vector(-kFarthestM, kFarthestM);
  if (j.has("direction")) own.direction = readDirection(j["direction"]);
  return own;
}

// By its name, or where none has that by what people call it.
class LampsByName {
 public:
  explicit LampsByName(const Scene& scene) : lamps_(findLamps(scene)), shown_(shownLampNames(scene, lamps_)) {}

  const std::vector<SceneLamp>& all() const { return lamps_; }
  const SceneLamp* find(const OwnLamp& own) const {
    const auto isNamed = [&](size_t i) { return lamps_[i].name == own.name; };
    const auto isShown = [&](size_t i) { return shown_[i] == own.name; };
    bool any = false;
    for (size_t i = 0; i < lamps_.size(); ++i) any = any || isNamed(i);
    size_t number = 0;
    for (size_t i = 0; i < lamps_.size(); ++i) {
      if ((any ? isNamed(i) : isShown(i)) && ++number == own.number) return &lamps_[i];
    }
    return nullptr;
  }

 private:
  std::vector<SceneLamp> lamps_;
  std::vector<std::string> shown_;
};

bool shinesBySurface(const SceneLamp& lamp, const Scene& scene) {
  return !lamp.instances.empty() || std::any_of(lamp.lamps.begin(), lamp.lamps.end(),
                                                [&](size_t i) { return scene.lamps[i].kind == LampKind::Area; });
}

void applyTo(const SceneLamp& at, const OwnLamp& own, Scene& scene) {
  const auto changed = [&](Vec3& light) {
    const Vec3 coloured = own.color ? *own.color * luminance(light) : light;
    light = coloured * static_cast<float>(own.dimming * own.factor);
  };
  for (const size_t i : at.lamps) {
    Lamp& lamp = scene.lamps[i];
    if (own.fluxLm) setLampFlux(lamp, *own.fluxLm / static_cast<double>(at.lamps.size()));
    changed(lamp.intensityCd), changed(lamp.luminanceCdM2);
    if (own.position) lamp.position = *own.position;
    if (!own.direction) continue;
    lamp.direction = *own.direction;
    const Vec3 up = importers::perpendicular(lamp.up, lamp.direction);
    lamp.up = isBlack(up) ? importers::perpendicular(std::abs(lamp.direction.x) < 0.9f ? Vec3{1, 0, 0} : Vec3{0, 1, 0},
                                                     lamp.direction)
                          : up;
  }
  std::map<int, bool> done;  // materials
  for (const uint32_t i : at.instances) {
    const int m = scene.meshes[static_cast<size_t>(scene.instances[i].mesh)].material;
    if (done.emplace(m, true).second) changed(scene.materials[static_cast<size_t>(m)].emission);
  }
}

}  // namespace

std::vector<OwnLamp> readOwnLamps(const JsonPlace& j) {
  std::vector<OwnLamp> out;
  const size_t count = j.arraySize();
  if (count > kMostOwn) j.fail(fmt::format("more than {} lamps", kMostOwn));
  for (size_t i = 0; i < std::min(count, kMostOwn); ++i) out.push_back(readOwn(j[i]));
  return out;
}

std::string missingLamp(const std::vector<OwnLamp>& own, const Scene& scene) {
  if (own.empty()) return {};
  const LampsByName lamps(scene);
  for (size_t i = 0; i < own.size(); ++i) {
    const SceneLamp* lamp = lamps.find(own[i]);
    if (lamp && (lamp->object >= 0 || lamp->lamps.empty()) && (own[i].position || own[i].direction))
      return fmt::format("own[{}]: '{}' is part of a thing and has no place of its own", i, printable(own[i].name));
    if (lamp && own[i].fluxLm && shinesBySurface(*lamp, scene))
      return fmt::format("own[{}].flux: '{}' shines by a surface; give 'factor' instead", i, printable(own[i].name));
    if (lamp) continue;
    std::map<std::string, size_t> counts;
    for (const SceneLamp& l : lamps.all()) ++counts[l.name];
    std::string list;
    size_t listed = 0;
    for (const auto& [name, count] : counts) {
      if (++listed <= kMostNames)
        list += fmt::format("{}'{}'{}", list.empty() ? "" : ", ", printable(name),
                            count > 1 ? fmt::format(" (1 to {})", count) : "");
    }
    return fmt::format("own[{}].name: the scene has no lamp {} '{}'; there are {}", i, own[i].number,
                       printable(own[i].name), list.empty() ? "none" : list);
  }
  return {};
}

void applyOwnLamps(const std::vector<OwnLamp>& own, Scene& scene) {
  if (own.empty()) return;
  partMaterials(scene);
  const LampsByName lamps(scene);
  for (const OwnLamp& o : own) {
    if (const SceneLamp* lamp = lamps.find(o)) applyTo(*lamp, o, scene);
  }
}

}  // namespace roomlight
