#include "view/open_home.h"

#include <fmt/format.h>

#include "home/light.h"
#include "import/lighting_lamps.h"
#include "json/json_file.h"
#include "json/json_reader.h"
#include "view/off_lamps.h"
#include "view/save_lighting.h"
#include "view/sun_by_date.h"

namespace roomlight::view {
namespace {

// What withoutDimming() takes out, checked as the whole file would be.
std::string wrongDimming(const nlohmann::json& document, const Scene& scene) {
  std::string error;
  const JsonPlace j(document, "", error);
  if (j.has("own")) {
    const std::vector<OwnLamp> own = readOwnLamps(j["own"]);
    if (error.empty()) error = missingLamp(own, scene);
  }
  const bool hasLamps = j.has("lamps") && j["lamps"].isArray();
  for (size_t i = 0; hasLamps && i < j["lamps"].arraySize(); ++i) j["lamps"][i].number("dimming", 0, 1, 1);
  return error;
}

// Whether the home's own sun and sky still shine.
bool keepsOwnSun(const nlohmann::json& document) {
  if (!document.is_object()) return true;
  const nlohmann::json scene = document.value("scene", nlohmann::json::object());
  return !document.contains("daylight") && !document.contains("sun") && !document.contains("sky") &&
         scene.value("suns", "keep") == "keep" && scene.value("sky", "keep") == "keep";
}

// What was added comes after what the file says, as it does in the scene; its sky and sun replace others.
void merge(const nlohmann::json& added, nlohmann::json& document) {
  if (!document.is_object()) document = nlohmann::json::object();
  if (added.contains("daylight") || added.contains("sky")) {
    for (const char* key : {"daylight", "sun", "sky"}) document.erase(key);
  }
  for (const auto& [key, value] : added.items()) {
    if (key == "lamps" && document.contains(key)) {
      document[key].insert(document[key].end(), value.begin(), value.end());
    } else {
      document[key] = value;
    }
  }
}

// Says of --light none what it does.
void switchOff(nlohmann::json& document) {
  if (!document.is_object()) document = {{"version", 1}};
  for (const char* key : {"lamps", "suns", "sky", "emission"}) document["scene"][key] = "off";
}

// The lighting file's, else the home's own while it shines; else there is none until somebody switches one on.
SunByDate sunOf(const LightingSource& lighting, const std::string& ownDaylight) {
  const nlohmann::json own = ownDaylight.empty() ? nlohmann::json() : nlohmann::json::parse(ownDaylight);
  std::optional<SunByDate> sun = sunOfLighting(lighting.document, lighting.folder);
  if (keepsOwnSun(lighting.document) && !own.is_null()) {
    sun = sunOfDaylight(own, {});
    if (sun) sun->placeFrom = PlaceFrom::Home;
  }
  return sun ? std::move(*sun) : sunOffAtFirst(lighting.document, own, home::assumedDaylight());
}

}  // namespace

Result<OpenedView> openHome(home::OpenWish wish) {
  LightingSource source;
  source.folder = wish.lighting.parent_path();
  if (!wish.lighting.empty()) {
    Result<nlohmann::json> document = readJsonFile(wish.lighting);
    if (!document) return Error{document.error()};
    source.document = std::move(document).value();
    wish.document = withoutDimming(source.document);
  }
  const nlohmann::json asRead = source.document;
  Result<home::OpenedHome> result = home::openHome(wish);
  if (!result) return Error{result.error()};
  home::OpenedHome& opened = result.value();
  if (!opened.lighting.is_null()) merge(opened.lighting, source.document);
  if (wish.light == home::LightWish::None) switchOff(source.document);
  if (source.document.contains("lamps")) source.lamps = source.document["lamps"].size();
  const OffLamps off = bringBackLamps(opened, source);
  if (!wish.lighting.empty()) {
    if (const std::string wrong = wrongDimming(asRead, opened.scene); !wrong.empty())
      return Error{fmt::format("{}: {}", wish.lighting.string(), wrong)};
  }
  ViewHome home(wish.scene.stem().string(), std::move(opened.scene));
  home.lighting = std::move(source);
  markOff(off, home);
  home.opened = stateOfFile(home, home.lighting.document);
  home.sun = sunOf(home.lighting, opened.daylight);
  if (opened.lighting.contains("daylight")) home.sun->placeFrom = PlaceFrom::Assumed;  // that was added
  return OpenedView{std::move(home), std::move(opened)};
}

}  // namespace roomlight::view
