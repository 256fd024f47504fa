// Lighting files, version 1 (docs/formats/lighting.md):
//   { "scene": { "lamps": "keep"|"off", "suns": .., "sky": .., "emission": "keep"|"off"|factor },
//     "lamps": [ { "type": "point"|"spot"|"area", "position": [x,y,z], "flux"|"intensity"|"luminance": "800 lm", .. } ],
//     "sun": { "direction": [x,y,z], "illuminance": "75000 lx" } or { "latitude", "longitude", "time" } or a list of them,
//     "sky": { "luminance": "3000 cd/m2" } or { "image": "sky.hdr", "unit": "1000 cd/m2" | "horizontalIlluminance": "10 klx" },
//     "daylight": { "sky": "clear"|"intermediate"|"overcast"|1..16, "latitude", "longitude", "time", .. } }
#include "import/lighting_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "import/json_file.h"
#include "import/lighting_daylight.h"
#include "import/lighting_sky.h"
#include "import/lighting_values.h"
#include "photometry/spot.h"

namespace roomlight {
namespace {

constexpr size_t kMostLamps = 100'000;

void readSpot(const JsonPlace& j, Lamp& lamp) {
  lamp.direction = readDirection(j["direction"]);
  const double outer = j.number("outerCone", 0.5, 90, 45), inner = j.number("innerCone", 0, 90, 0);
  if (inner > outer) j["innerCone"].fail("must not be larger than outerCone");
  lamp.outerConeRad = static_cast<float>(rad(outer));
  lamp.innerConeRad = static_cast<float>(rad(inner));
}

void readArea(const JsonPlace& j, Lamp& lamp) {
  lamp.direction = readDirection(j["direction"]);
  lamp.widthM = static_cast<float>(j["width"].number(1e-4, 1000));
  lamp.heightM = static_cast<float>(j["height"].number(1e-4, 1000));
  Vec3 up = j.has("up") ? readDirection(j["up"]) : std::abs(lamp.direction.y) < 0.99f ? Vec3{0, 1, 0}
                                                                                      : Vec3{0, 0, -1};
  up -= lamp.direction * dot(up, lamp.direction);
  if (length(up) < 1e-3f) {
    j["up"].fail("must not point along 'direction'");
    return;
  }
  lamp.up = normalize(up);
}

Lamp readLamp(const JsonPlace& j, size_t number) {
  Lamp lamp;
  if (!j.isObject({"name", "type", "position", "direction", "up", "flux", "intensity", "luminance", "temperature", "color", "innerCone", "outerCone", "width", "height"})) return lamp;
  lamp.name = j.text("name", fmt::format("lamp {}", number + 1));
  lamp.position = j["position"].vector(-kFarthestM, kFarthestM);
  const Vec3 c = readColour(j);
  const std::string type = j["type"].oneOf({"point", "spot", "area"});
  const std::string why = "for a lamp of type " + type;
  if (type == "area") {
    lamp.kind = LampKind::Area;
    forbid(j, {"intensity", "innerCone", "outerCone"}, why);
    readArea(j, lamp);
    const std::string unit = theOne(j, {"flux", "luminance"});
    const double area = static_cast<double>(lamp.widthM) * lamp.heightM;
    if (unit == "flux") lamp.luminanceCdM2 = c * static_cast<float>(j["flux"].quantity(Unit::Lumen, 0, kMostLight) / (kPi * std::max(area, 1e-8)));
    if (unit == "luminance") lamp.luminanceCdM2 = c * static_cast<float>(j["luminance"].quantity(Unit::CandelaPerM2, 0, kMostLight));
    if (luminance(lamp.luminanceCdM2) > 1.001 * kMostLight) j["flux"].fail("is more than 1e12 cd/m2 on so small an area");
    return lamp;
  }
  forbid(j, {"luminance", "width", "height", "up"}, why);
  double fluxPerCandela = 4 * kPi;
  if (type == "spot") {
    lamp.kind = LampKind::Spot;
    readSpot(j, lamp);
    fluxPerCandela = spotFluxPerCandela(std::cos(lamp.innerConeRad), std::cos(lamp.outerConeRad));
  } else {
    forbid(j, {"direction", "innerCone", "outerCone"}, why);
  }
  const std::string unit = theOne(j, {"flux", "intensity"});
  if (unit == "flux") lamp.intensityCd = c * static_cast<float>(j["flux"].quantity(Unit::Lumen, 0, kMostLight) / fluxPerCandela);
  if (unit == "intensity") lamp.intensityCd = c * static_cast<float>(j["intensity"].quantity(Unit::Candela, 0, kMostLight));
  return lamp;
}

// What the file says about the light that the scene brought along.
struct Kept {
  bool lamps = true, suns = true, sky = true;
  float emission = 1;
};

Kept readKept(const JsonPlace& j) {
  Kept kept;
  if (!j.isObject({"lamps", "suns", "sky", "emission"})) return kept;
  const auto keep = [&](const char* key) { return !j.has(key) || j[key].oneOf({"keep", "off"}) == "keep"; };
  kept.lamps = keep("lamps");
  kept.suns = keep("suns");
  kept.sky = keep("sky");
  if (j.has("emission")) {
    if (j["emission"].isNumber()) {
      kept.emission = static_cast<float>(j["emission"].number(0, 1e6));
    } else {
      kept.emission = keep("emission") ? 1.0f : 0.0f;
    }
  }
  return kept;
}

struct Lighting {
  Kept kept;
  std::vector<Lamp> lamps;
  std::vector<Sun> suns;
  std::optional<Sky> sky;
};

Lighting readLighting(const JsonPlace& root, const std::filesystem::path& folder) {
  Lighting out;
  if (!root.isObject({"version", "comment", "scene", "lamps", "sun", "sky", "daylight"})) return out;
  if (root.has("version") && root["version"].number(1, 1e6) != 1) root["version"].fail("must be 1");
  if (root.has("comment")) root["comment"].text();
  if (root.has("scene")) out.kept = readKept(root["scene"]);
  if (root.has("lamps")) {
    const JsonPlace lamps = root["lamps"];
    const size_t count = lamps.arraySize();
    if (count > kMostLamps) lamps.fail(fmt::format("more than {} lamps", kMostLamps));
    for (size_t i = 0; i < std::min(count, kMostLamps); ++i) out.lamps.push_back(readLamp(lamps[i], i));
  }
  if (root.has("sun")) {
    const JsonPlace sun = root["sun"];
    const size_t count = sun.isArray() ? sun.arraySize() : 1;
    if (count > 16) sun.fail("more than 16 suns");
    for (size_t i = 0; i < std::min<size_t>(count, 16); ++i) out.suns.push_back(readSun(sun.isArray() ? sun[i] : sun));
  }
  if (root.has("sky")) out.sky = readSky(root["sky"], folder);
  if (root.has("daylight")) {
    forbid(root, {"sun", "sky"}, "beside 'daylight', which brings both");
    Daylight daylight = readDaylight(root["daylight"], folder);
    out.suns.push_back(daylight.sun);
    out.sky = std::move(daylight.sky);
  }
  return out;
}

// The one thing that depends on the scene: its emission times the factor must stay in range.
bool emissionStaysInRange(const Scene& scene, float factor) {
  return std::all_of(scene.materials.begin(), scene.materials.end(), [&](const Material& m) {
    return factor <= 1 || maxComponent(m.emission) <= kMostLight / factor;
  });
}

void apply(Lighting& lighting, Scene& scene) {
  const Kept& kept = lighting.kept;
  if (!kept.lamps) std::erase_if(scene.lamps, [](const Lamp& l) { return l.kind != LampKind::Area; });
  if (!kept.suns) scene.suns.clear();
  if (!kept.sky) scene.sky = {};
  for (Material& m : scene.materials) m.emission *= kept.emission;
  const size_t first = scene.lamps.size();
  scene.lamps.insert(scene.lamps.end(), lighting.lamps.begin(), lighting.lamps.end());
  addAreaLampMeshes(scene, first);
  for (const Sun& sun : lighting.suns) {
    if (!isBlack(sun.illuminanceLux)) scene.suns.push_back(sun);
  }
  if (lighting.sky) scene.sky = std::move(*lighting.sky);
}

}  // namespace

Status applyLightingFile(const std::filesystem::path& file, Scene& scene) {
  const Result<nlohmann::json> json = readJsonFile(file);
  if (!json) return Error{json.error()};
  std::string error;
  Lighting lighting = readLighting(JsonPlace(json.value(), "", error), file.parent_path());
  if (!error.empty()) return Error{fmt::format("{}: {}", file.string(), error)};
  if (!emissionStaysInRange(scene, lighting.kept.emission)) {
    return Error{fmt::format("{}: scene.emission: would make a material brighter than 1e12 cd/m2", file.string())};
  }
  apply(lighting, scene);
  return Ok{};
}

}  // namespace roomlight
