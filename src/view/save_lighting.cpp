#include "view/save_lighting.h"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <set>

#include "import/lighting_lamps.h"
#include "scene/scene_lamps.h"
#include "view/sun_by_date.h"

namespace roomlight::view {
namespace {

using nlohmann::json;

double rounded(double v) { return std::round(v * 1e5) / 1e5; }
json list(Vec3 v) {
  return {rounded(static_cast<double>(v.x)), rounded(static_cast<double>(v.y)), rounded(static_cast<double>(v.z))};
}

void putColour(const LampState& s, json& entry) {
  if (!s.temperatureK && !s.color) return;
  entry.erase("temperature"), entry.erase("color");
  if (s.temperatureK) entry["temperature"] = fmt::format("{} K", std::round(*s.temperatureK));
  if (s.color) entry["color"] = list(*s.color);
}

double dimmingOf(const LampState& s) { return s.on ? rounded(static_cast<double>(s.dim)) : 0; }

std::string inLumen(double fluxLm) { return fmt::format("{:.6g} lm", fluxLm); }

// One of the file's lamps that a lamp is made of, as it stands in a scene that is in that state.
void putFileLamp(const EditableLamp& lamp, const Lamp& full, const LampState& s, const Lamp& now, json& entry) {
  entry["dimming"] = dimmingOf(s);
  if (!(s.position == lamp.position)) entry["position"] = list(now.position);
  if (!(s.direction == lamp.direction)) entry["direction"] = list(now.direction);
  const bool hasUp = lamp.kind == "area" || lamp.kind == "photometric";
  if (hasUp && (s.turnDeg != 0 || !(s.direction == lamp.direction))) entry["up"] = list(now.up);
  if (lamp.fluxLm > 0 && s.fluxLm != lamp.fluxLm) {
    entry.erase("intensity"), entry.erase("luminance"), entry.erase("lightLossFactor");
    entry["flux"] = inLumen(s.fluxLm * (lampFluxLm(full) / lamp.fluxLm));
  }
  putColour(s, entry);
}

json ownLamp(const EditableLamp& lamp, size_t number, const LampState& s) {
  json entry = {{"name", lamp.name}, {"dimming", dimmingOf(s)}};
  if (number > 1) entry["number"] = number;
  if (lamp.fluxAssumed) {
    entry["flux"] = inLumen(s.fluxLm);
  } else if (lamp.fluxLm > 0 && s.fluxLm != lamp.fluxLm) {
    entry["factor"] = rounded(s.fluxLm / lamp.fluxLm);
  }
  if (!(s.position == lamp.position)) entry["position"] = list(s.position);
  if (!(s.direction == lamp.direction)) entry["direction"] = list(s.direction);
  putColour(s, entry);
  return entry;
}

void makeAbsolute(const std::filesystem::path& folder, const char* key, json& j) {
  if (j.is_object() && j.contains(key) && j[key].is_string())
    j[key] = std::filesystem::absolute(folder / j[key].get<std::string>()).lexically_normal().string();
}

void putSun(const ViewHome& home, const HomeState& state, json& document) {
  if (!home.sun || !state.sun) return;
  const bool offAtFirst = !home.sun->atStart.on;
  if (offAtFirst && !state.sun->on) return;
  const char* key = home.sun->isDaylight ? "daylight" : "sun";
  json source = home.sun->source;
  source["time"] = timeText(*state.sun, home.sun->utcOffsetH);
  if (state.sun->on && !offAtFirst && document.contains(key)) {
    document[key]["time"] = source["time"];
    return;
  }
  if (*state.sun == home.sun->atStart) return;
  // What shines without a date, or is the home's own, gives way.
  document["scene"]["suns"] = "off";
  if (home.sun->isDaylight) document["scene"]["sky"] = "off";
  document.erase(key);
  if (offAtFirst) document.erase("sun"), document.erase("sky");
  if (state.sun->on) document[key] = source;
}

// Leaves it to `own` which lamps are off.
void keepKindsOn(const KindsOff& off, json& document) {
  json& scene = document["scene"];
  if (off.lamps) scene.erase("lamps");
  if (off.emission) scene.erase("emission");
  if (scene.empty()) document.erase("scene");
}

// Places of lamps, and nothing else: meshes and textures are not needed.
std::vector<Lamp> lampsIn(const ViewHome& home, const HomeState& state) {
  Scene scene;
  scene.lamps = home.scene.lamps, scene.instances = home.scene.instances, scene.materials = home.scene.materials;
  stage(home.editable, home.editable.atStart, state, scene);
  return std::move(scene.lamps);
}

// The file's lamp that a lamp is; none: the scene's own.
std::optional<size_t> entryOf(const ViewHome& home, const EditableLamp& lamp) {
  const size_t first = home.scene.lamps.size() - home.lighting.lamps;
  if (lamp.sources.empty() || lamp.sources[0].lamp < first) return {};
  return lamp.sources[0].lamp - first;
}

// All lamps of the file that a lamp is made of.
void putFileLamps(const ViewHome& home, const EditableLamp& lamp, const LampState& s, const std::vector<Lamp>& now,
                  json& entries) {
  const size_t first = home.scene.lamps.size() - home.lighting.lamps;
  for (const EditableLamp::Source& source : lamp.sources)
    putFileLamp(lamp, source.full, s, now[source.lamp], entries[source.lamp - first]);
}

// Whether a lamp was switched on that the file switches off with all of its kind.
bool anyKeptOffIsOn(const ViewHome& home, const HomeState& state) {
  for (size_t i = 0; i < state.lamps.size(); ++i) {
    if (home.lighting.keepsOff(i) && state.lamps[i].on) return true;
  }
  return false;
}

// A lamp dimmed to nothing is off; switched on, it is as bright as can be.
void putDimming(double dimming, LampState& s) {
  s.on = dimming > 0;
  if (s.on) s.dim = static_cast<float>(dimming);
}

void putOwn(const OwnLamp& own, const EditableLamp& lamp, LampState& s) {
  const bool shines = s.on || (lamp.fluxAssumed && own.fluxLm);
  putDimming(own.dimming, s);
  s.on = s.on && shines;
  s.fluxLm = own.fluxLm.value_or(lamp.fluxLm * own.factor);
  s.temperatureK = own.temperatureK;
  if (own.color && !own.temperatureK) s.color = own.color;
  s.position = own.position.value_or(s.position), s.direction = own.direction.value_or(s.direction);
}

}  // namespace

std::string lightingFile(const ViewHome& home, const HomeState& state) {
  json document = home.lighting.document.is_object() ? home.lighting.document : json{{"version", 1}};
  document.erase("own");
  const std::vector<Lamp> lamps = lampsIn(home, state);
  const bool anyBack = anyKeptOffIsOn(home, state);
  if (anyBack) keepKindsOn(home.lighting.off, document);
  std::map<std::string, size_t> numbers;
  json own = json::array();
  for (size_t i = 0; i < home.editable.lamps.size(); ++i) {
    const EditableLamp& lamp = home.editable.lamps[i];
    LampState now = state.lamps[i], first = home.editable.atStart.lamps[i];
    if (entryOf(home, lamp)) {
      putFileLamps(home, lamp, now, lamps, document["lamps"]);
      continue;
    }
    const size_t number = ++numbers[lamp.name];
    if (home.lighting.keepsOff(i) && !anyBack) now.on = true;  // how far it is dimmed then
    if (lamp.fluxAssumed) first.on = false;
    if (!(now == first)) own.push_back(ownLamp(lamp, number, now));
  }
  if (!own.empty()) document["own"] = own;
  putSun(home, state, document);
  const std::filesystem::path& folder = home.lighting.folder;
  if (document.contains("lamps")) {
    for (json& lamp : document["lamps"]) makeAbsolute(folder, "file", lamp);
  }
  if (document.contains("sky")) makeAbsolute(folder, "image", document["sky"]);
  if (document.contains("daylight")) makeAbsolute(folder, "weather", document["daylight"]);
  return document.dump(2, ' ', false, json::error_handler_t::replace) + "\n";
}

json withoutDimming(json document) {
  document.erase("own");
  if (document.contains("lamps") && document["lamps"].is_array()) {
    for (json& lamp : document["lamps"]) {
      if (lamp.is_object()) lamp.erase("dimming");
    }
  }
  return document;
}

HomeState stateOfFile(const ViewHome& home, const json& document) {
  HomeState state = home.editable.atStart;
  std::string ignored;  // the file was read before: nothing is wrong in it
  const std::vector<OwnLamp> own = document.is_object() && document.contains("own")
                                       ? readOwnLamps(JsonPlace(document["own"], "own", ignored))
                                       : std::vector<OwnLamp>();
  std::set<std::string> names;
  for (const EditableLamp& lamp : home.editable.lamps) names.insert(lamp.name);
  std::map<std::string, size_t> numbers, shownNumbers;
  for (size_t i = 0; i < home.editable.lamps.size(); ++i) {
    const EditableLamp& lamp = home.editable.lamps[i];
    LampState& s = state.lamps[i];
    if (const auto entry = entryOf(home, lamp)) {
      const json& from = document["lamps"][*entry];
      if (from.is_object()) putDimming(from.value("dimming", 1.0), s);
      continue;
    }
    const size_t number = ++numbers[lamp.name], shownNumber = ++shownNumbers[lamp.label];
    s.on = !home.lighting.keepsOff(i) && !lamp.fluxAssumed;
    for (const OwnLamp& o : own) {
      // By its name, or where none has that by what people call it.
      const bool isIt = names.contains(o.name) ? o.name == lamp.name && o.number == number
                                               : o.name == lamp.label && o.number == shownNumber;
      if (isIt) putOwn(o, lamp, s);
    }
  }
  return state;
}

}  // namespace roomlight::view
