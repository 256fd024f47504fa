#include "home/open_home.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "home/cameras.h"
#include "home/light.h"
#include "home/rooms.h"
#include "home/unit.h"
#include "import/lighting_file.h"
#include "json/json_file.h"
#include "scene/find_named.h"
#include "scene/scene_change.h"

namespace roomlight::home {
namespace {

using Json = nlohmann::ordered_json;

constexpr size_t kMostNamed = 3;
constexpr std::array kLightKeys = {"scene", "lamps", "sun", "sky", "daylight"};  // of lighting files

std::string quoted(const std::vector<std::string>& names) {
  std::string text;
  for (size_t i = 0; i < std::min(names.size(), kMostNamed); ++i)
    text += fmt::format("{}'{}'", i > 0 ? ", " : "", names[i]);
  return names.size() > kMostNamed ? fmt::format("{} and {} more", text, names.size() - kMostNamed) : text;
}

LightBefore lightOf(const Scene& scene) {
  LightBefore light{scene.lamps, {}};
  for (const Material& m : scene.materials) light.emission.push_back(m.emission);
  return light;
}

void switchOff(Scene& scene) {
  scene.lamps.clear();
  scene.suns.clear();
  scene.sky = {};
  for (Material& m : scene.materials) m.emission = {};
}

// The unit that a lighting file's places are meant for: what it says, else the file's own. None where it has no places.
std::optional<double> unitOf(const nlohmann::json& lighting) {
  if (!lighting.is_object()) return std::nullopt;
  if (lighting.contains("metresPerUnit") && lighting["metresPerUnit"].is_number())
    return lighting["metresPerUnit"].get<double>();
  return lighting.contains("lamps") || lighting.contains("ground") ? std::optional(1.0) : std::nullopt;
}

bool decidesLight(const nlohmann::json& lighting) {
  return lighting.is_object() &&
         std::any_of(kLightKeys.begin(), kLightKeys.end(), [&](const char* key) { return lighting.contains(key); });
}

void takeUnit(const OpenWish& wish, StatedUnit stated, const nlohmann::json& lighting, OpenedHome& home) {
  if (wish.metresPerUnit || stated == StatedUnit::Certain) {
    home.metresPerUnit = wish.metresPerUnit.value_or(1);
    return;
  }
  UnitGuess guess;
  if (const std::optional<double> meant = unitOf(lighting)) {
    guess.metres = *meant;
  } else {
    const RayScene rays(home.scene);
    guess = guessUnit(proportionsOf(rays), stated);
  }
  home.metresPerUnit = guess.metres;
  if (guess.metres == 1) return;
  scaleScene(home.scene, static_cast<float>(guess.metres));
  if (!guess.because.empty())
    home.notes.push_back(fmt::format("taken as {} ({:g} m a unit), else {}; --metres-per-unit decides", guess.name,
                                     guess.metres, guess.because));
}

// Which camera of the file is shown where nobody says; none that sees anything: its number of cameras.
int cameraInUse(const RayScene& rays, const OpenedHome& home, std::string& fault) {
  for (size_t i = 0; i < home.fileCameras; ++i) {
    const std::string wrong = faultOf(rays, home.scene.rooms, home.scene.cameras[i]);
    if (wrong.empty()) return static_cast<int>(i);
    if (i == 0) fault = wrong;
  }
  return static_cast<int>(home.fileCameras);
}

// As --camera takes it.
std::string quotedOrNumber(const Scene& scene, size_t camera) {
  const std::string& name = scene.cameras[camera].name;
  return name.empty() ? fmt::format("{}", camera + 1) : fmt::format("'{}'", name);
}

void chooseCamera(const RayScene& rays, const OpenWish& wish, bool lightComes, OpenedHome& home) {
  Scene& scene = home.scene;
  home.fileCameras = scene.cameras.size();
  std::string fault;
  scene.cameraInUse = cameraInUse(rays, home, fault);
  const auto isUnknown = [&](const std::string& name) { return !name.empty() && !findCamera(scene, name); };
  const bool unknown =
      isUnknown(wish.camera) || std::any_of(wish.moreCameras.begin(), wish.moreCameras.end(), isUnknown);
  if (wish.allCameras || unknown || !home.placed()) {
    for (Camera& c : proposeCameras(rays, home.scene.rooms, lightComes)) {
      if (findCamera(scene, c.name) && home.fileCameras > 0) c.name += " (proposed)";  // the file's goes by the name
      scene.cameras.push_back(std::move(c));
    }
  }
  if (!fault.empty())
    home.notes.push_back(fmt::format("the file's camera {} {}; {} is shown instead, --camera decides",
                                     quotedOrNumber(scene, 0), fault,
                                     quotedOrNumber(scene, static_cast<size_t>(scene.cameraInUse))));
}

// After the choice of the camera that is shown by default: which one that is stays as it was.
void cutOpen(const RayScene& rays, OpenedHome& home) {
  for (size_t i = 0; i < home.fileCameras; ++i) {
    Camera& camera = home.scene.cameras[i];
    if (const std::optional<float> cut = cutHeightFor(rays, home.scene.rooms, camera)) camera.cutHeightM = *cut;
  }
}

// `decided`: a lighting file says what shines, even if that is nothing.
std::optional<Mood> moodOf(LightWish wish, const OwnLight& own, bool decided) {
  switch (wish) {
    case LightWish::Auto: return own.none() && !decided ? std::optional(Mood::Auto) : std::nullopt;
    case LightWish::Day: return Mood::Day;
    case LightWish::Evening: return Mood::Evening;
    case LightWish::Night: return Mood::Night;
    case LightWish::None:
    case LightWish::File: break;
  }
  return std::nullopt;
}

void tellOwnLight(const OwnLight& own, bool added, LightWish wish, OpenedHome& home) {
  if (!own.farLamps.empty())
    home.warnings.push_back(fmt::format("{} nothing: {}",
                                        own.farLamps.size() == 1
                                            ? "a lamp far outside the scene lights"
                                            : fmt::format("{} lamps far outside the scene light", own.farLamps.size()),
                                        quoted(own.farLamps)));
  if (added) return;
  if (own.none()) {
    home.warnings.push_back(wish == LightWish::None
                                ? "there is no light"
                                : "nothing in it shines; --light auto, the default of render, adds light");
  } else if (own.faint()) {
    home.warnings.push_back(
        fmt::format("the light in it is next to nothing, about {:.1g} lx; --light day adds daylight", own.meanLux()));
  }
}

// What will be shown; what is wrong with a camera's name is told when it is asked for.
Camera shownCamera(const OpenWish& wish, const OpenedHome& home) {
  const Result<Camera> camera = findCamera(home.scene, wish.camera);
  return camera ? camera.value() : defaultCamera(home.scene);
}

void addLight(const RayScene& rays, const OpenWish& wish, const OwnLight& own, std::optional<Mood> mood,
              OpenedHome& home) {
  tellOwnLight(own, mood.has_value(), wish.light, home);
  if (!mood) return;
  AddedLight light = lightFor(rays, home.scene.rooms, shownCamera(wish, home), *mood,
                              home.daylight.empty() ? Json() : Json::parse(home.daylight).at("ground"));
  std::string why = "no light in the file: ";
  if (own.outdoors()) {
    why = "the sun and sky of the file do not come in: ";
  } else if (own.meanLux() > 0) {
    why = fmt::format("the light in the file is next to nothing, about {:.1g} lx: ", own.meanLux());
  }
  if (*mood != Mood::Auto) why.clear();
  home.notes.push_back(
      fmt::format("{}added {}; --light or --lighting decides, --write-lighting FILE keeps it", why, light.summary));
  home.added = light.summary;
  home.lighting = std::move(light.document);
  if (home.metresPerUnit != 1) home.lighting["metresPerUnit"] = home.metresPerUnit;
}

}  // namespace

const std::vector<std::pair<std::string, std::string>>& lightWishes() {
  static const std::vector<std::pair<std::string, std::string>> names = {
      {"auto", "the file's own; where it has none, daylight and a ceiling lamp in each room are added"},
      {"day", "a clear day instead of the file's sun and sky"},
      {"evening", "the sky after sunset, and a lamp in each room that has none"},
      {"night", "the same under a sky that is all but dark"},
      {"none", "no light but that of --lighting"},
      {"file", "only what the file holds"}};
  return names;
}

Result<LightWish> lightWishFromName(const std::string& name) {
  std::string names;
  for (size_t i = 0; i < lightWishes().size(); ++i) {
    if (lightWishes()[i].first == name) return static_cast<LightWish>(i);
    names += (i > 0 ? ", " : "") + lightWishes()[i].first;
  }
  return Error{fmt::format("--light {}: no such light; there are {}", name, names)};
}

Result<OpenedHome> openHome(const OpenWish& wish) {
  ImportOptions options = wish.import;
  options.metresPerUnit = wish.metresPerUnit.value_or(1);
  Result<Imported> imported = importScene(wish.scene, options);
  if (!imported) return Error{imported.error()};
  return openImported(std::move(imported.value()), wish);
}

Result<OpenedHome> openImported(Imported imported, const OpenWish& wish) {
  OpenedHome home;
  home.scene = std::move(imported.scene);
  home.warnings = std::move(imported.warnings);
  home.faults = std::move(imported.faults), home.faultCount = imported.faultCount;
  home.photo = imported.photo, home.daylight = std::move(imported.daylight);
  home.offLamps = std::move(imported.offLamps);
  nlohmann::json lighting;
  if (!wish.lighting.empty()) {
    Result<nlohmann::json> read = wish.document ? Result<nlohmann::json>(*wish.document) : readJsonFile(wish.lighting);
    if (!read) return Error{read.error()};
    lighting = std::move(read.value());
  }
  takeUnit(wish, imported.unit, lighting, home);
  home.before = lightOf(home.scene);
  if (wish.light == LightWish::None) switchOff(home.scene);
  if (!wish.lighting.empty()) {
    if (const Status s = applyLighting(lighting, wish.lighting, home.scene, &home.warnings); !s)
      return Error{s.error()};
  }
  {
    const RayScene rays(home.scene);
    if (home.scene.rooms.empty()) home.scene.rooms = findRooms(rays);
    const OwnLight own = ownLightOf(home.scene);
    const bool decided = decidesLight(lighting);
    std::optional<Mood> mood = moodOf(wish.light, own, decided);
    chooseCamera(rays, wish, own.outdoors() || mood.has_value(), home);
    cutOpen(rays, home);
    if (wish.light == LightWish::Auto && !decided && !mood && !own.lamps && own.indoorLux < 0.5 &&
        !outdoorLightComesIn(rays, home.scene.rooms, shownCamera(wish, home)))
      mood = Mood::Auto;
    addLight(rays, wish, own, mood, home);
  }
  if (!home.lighting.is_null()) {
    if (const Status s = applyLighting(home.lighting, "added light", home.scene, &home.warnings); !s)
      return Error{s.error()};
  }
  return home;
}

}  // namespace roomlight::home
