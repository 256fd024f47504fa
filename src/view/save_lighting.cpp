#include "view/save_lighting.h"

#include <fmt/format.h>

#include <cmath>
#include <map>

#include "import/lighting_own.h"
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

// A lamp of the file, as it stands in a scene that is in that state.
void putFileLamp(const EditableLamp& lamp, const LampState& s, const Lamp& now, json& entry) {
  entry["dimming"] = dimmingOf(s);
  if (!(s.position == lamp.position)) entry["position"] = list(s.position);
  if (!(s.direction == lamp.direction)) {
    entry["direction"] = list(now.direction);
    if (lamp.kind == "area" || lamp.kind == "photometric") entry["up"] = list(now.up);
  }
  if (lamp.fluxLm > 0 && s.fluxLm != lamp.fluxLm) {
    entry.erase("intensity"), entry.erase("luminance"), entry.erase("lightLossFactor");
    entry["flux"] = fmt::format("{:.6g} lm", s.fluxLm);
  }
  putColour(s, entry);
}

json ownLamp(const EditableLamp& lamp, size_t number, const LampState& s) {
  json entry = {{"name", lamp.name}, {"dimming", dimmingOf(s)}};
  if (number > 1) entry["number"] = number;
  if (lamp.fluxLm > 0 && s.fluxLm != lamp.fluxLm) entry["factor"] = rounded(s.fluxLm / lamp.fluxLm);
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
  json source = home.sun->source;
  source["time"] = timeText(*state.sun, home.sun->utcOffsetH);
  const char* key = home.sun->isDaylight ? "daylight" : "sun";
  if (document.contains(key)) {
    document[key]["time"] = source["time"];
  } else if (!(state.sun == home.sun->atStart)) {  // the home's own: replaced once it was changed
    document["scene"]["suns"] = "off", document["scene"]["sky"] = "off";
    document[key] = source;
  }
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

}  // namespace

std::string lightingFile(const ViewHome& home, const HomeState& state) {
  json document = home.lighting.document.is_object() ? home.lighting.document : json{{"version", 1}};
  document.erase("own");
  const std::vector<Lamp> lamps = lampsIn(home, state);
  std::map<std::string, size_t> numbers;
  json own = json::array();
  for (size_t i = 0; i < home.editable.lamps.size(); ++i) {
    const EditableLamp& lamp = home.editable.lamps[i];
    if (const auto entry = entryOf(home, lamp)) {
      putFileLamp(lamp, state.lamps[i], lamps[lamp.sources[0].lamp], document["lamps"][*entry]);
      continue;
    }
    const size_t number = ++numbers[lamp.name];
    if (!(state.lamps[i] == home.editable.atStart.lamps[i])) own.push_back(ownLamp(lamp, number, state.lamps[i]));
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
  std::map<std::string, size_t> numbers;
  for (size_t i = 0; i < home.editable.lamps.size(); ++i) {
    const EditableLamp& lamp = home.editable.lamps[i];
    LampState& s = state.lamps[i];
    if (const auto entry = entryOf(home, lamp)) {
      const json& from = document["lamps"][*entry];
      s.dim = from.is_object() ? static_cast<float>(from.value("dimming", 1.0)) : 1;
      continue;
    }
    const size_t number = ++numbers[lamp.name];
    for (const OwnLamp& o : own) {
      if (o.name != lamp.name || o.number != number) continue;
      s.dim = static_cast<float>(o.dimming), s.fluxLm = lamp.fluxLm * o.factor;
      s.temperatureK = o.temperatureK;
      if (o.color && !o.temperatureK) s.color = o.color;
      s.position = o.position.value_or(s.position), s.direction = o.direction.value_or(s.direction);
    }
  }
  return state;
}

}  // namespace roomlight::view
