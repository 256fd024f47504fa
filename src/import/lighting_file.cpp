// Lighting files, version 1 (docs/formats/lighting.md):
//   { "scene": { "lamps": "keep"|"off", "suns": .., "sky": .., "emission": "keep"|"off"|factor },
//     "lamps": [ { "type": "point"|"spot"|"area"|"photometric", "position": [x,y,z], "flux"|"intensity"|"luminance": "800 lm", .. } ],
//     "sun": { "direction": [x,y,z], "illuminance": "75000 lx" } or { "latitude", "longitude", "time" } or a list of them,
//     "sky": { "luminance": "3000 cd/m2" } or { "image": "sky.hdr", "unit": "1000 cd/m2" | "horizontalIlluminance": "10 klx" } }
#include "import/lighting_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <optional>

#include "base/image_io.h"
#include "import/json_file.h"
#include "import/json_reader.h"
#include "import/lighting_json.h"
#include "import/lighting_lamps.h"
#include "photometry/sun.h"

namespace roomlight {
namespace {

using namespace importers;

constexpr size_t kMostLamps = 100'000;

// By direction with its illuminance, or by place and time under a clear sky. Below the horizon there is no sun.
Sun readSun(const JsonPlace& j) {
  Sun sun;
  if (!j.isObject({"name", "direction", "latitude", "longitude", "time", "north", "illuminance", "angularDiameter", "temperature", "color"})) return sun;
  sun.name = j.text("name", "sun");
  sun.halfAngleRad = static_cast<float>(rad(j.number("angularDiameter", 0, 90, 0.533) / 2));
  const Vec3 c = colour(j);
  double lux = 0;
  if (j.has("direction")) {
    for (const char* key : {"latitude", "longitude", "time", "north"}) {
      if (j.has(key)) j[key].fail("give 'direction' or place and time, not both");
    }
    sun.toLight = direction(j["direction"]);
    lux = j["illuminance"].quantity(Unit::Lux, 0, kMostLight);
  } else {
    const double latitude = j["latitude"].number(-90, 90), longitude = j["longitude"].number(-180, 180), north = j.number("north", -360, 360, 0);
    const Result<Moment> moment = parseMoment(j["time"].text());
    if (!moment) {
      j["time"].fail(moment.error());
      return sun;
    }
    const SunPosition p = sunPosition(moment.value(), latitude, longitude);
    const double bearing = p.bearingRad - rad(north);  // from the scene's -z axis, clockwise seen from above
    sun.toLight = normalize(Vec3{static_cast<float>(std::sin(bearing) * std::cos(p.altitudeRad)), static_cast<float>(std::sin(p.altitudeRad)),
                                 static_cast<float>(-std::cos(bearing) * std::cos(p.altitudeRad))});
    lux = j.has("illuminance") ? j["illuminance"].quantity(Unit::Lux, 0, kMostLight) : clearSkySunLux(moment.value(), p.altitudeRad);
    if (p.altitudeRad <= 0) lux = 0;
  }
  sun.illuminanceLux = c * static_cast<float>(lux);
  return sun;
}

// Illuminance that an equirectangular picture gives to a horizontal surface, in its own unit.
double horizontalIlluminance(const Image& image) {
  double sum = 0;
  for (int y = 0; 2 * y < image.height; ++y) {
    // Exact integral of cos over a row; of an odd number of rows the middle one counts with its upper half.
    const double low = std::sin(std::numbers::pi * y / image.height), high = std::sin(std::min(0.5, (y + 1.0) / image.height) * std::numbers::pi);
    double row = 0;
    for (int x = 0; x < image.width; ++x) row += luminance(image.at(x, y));
    sum += row * 0.5 * (high * high - low * low);
  }
  return sum * 2 * std::numbers::pi / image.width;
}

void readSkyImage(const JsonPlace& j, const std::filesystem::path& folder, Sky& sky) {
  const std::filesystem::path file = folder / j["image"].text();
  // Opening a pipe or a terminal would wait for it.
  std::error_code code;
  if (std::filesystem::exists(file, code) && !std::filesystem::is_regular_file(file, code)) {
    j["image"].fail("is not a file");
    return;
  }
  Result<Image> image = readImage(file);
  if (!image) {
    j["image"].fail(image.error());
    return;
  }
  sky.image = std::move(image.value());
  double factor = 1;
  const std::string unit = theOne(j, {"unit", "horizontalIlluminance"});
  if (unit == "unit") factor = j["unit"].quantity(Unit::CandelaPerM2, 0, kMostLight);
  if (unit == "horizontalIlluminance") {
    const double now = horizontalIlluminance(sky.image);
    const double wanted = j["horizontalIlluminance"].quantity(Unit::Lux, 0, kMostLight);
    if (!(now > 0)) j["horizontalIlluminance"].fail("the picture's upper half is black");
    factor = wanted / std::max(now, 1e-30);
  }
  for (Vec3& p : sky.image.pixels) {
    p *= static_cast<float>(factor);
    if (!(minComponent(p) >= 0) || !(maxComponent(p) < kMostLight)) {
      j["image"].fail("holds values that are negative, not finite or beyond 1e12 cd/m2");
      return;
    }
  }
}

Sky readSky(const JsonPlace& j, const std::filesystem::path& folder) {
  Sky sky;
  if (!j.isObject({"luminance", "temperature", "color", "image", "unit", "horizontalIlluminance", "rotation"})) return sky;
  sky.rotationRad = static_cast<float>(rad(j.number("rotation", -360, 360, 0)));
  const std::string kind = theOne(j, {"luminance", "image"});
  if (kind == "image") {
    for (const char* key : {"temperature", "color"}) {
      if (j.has(key)) j[key].fail("means nothing beside 'image'");
    }
    readSkyImage(j, folder, sky);
  } else if (kind == "luminance") {
    for (const char* key : {"unit", "horizontalIlluminance"}) {
      if (j.has(key)) j[key].fail("means nothing beside 'luminance'");
    }
    sky.luminanceCdM2 = colour(j) * static_cast<float>(j["luminance"].quantity(Unit::CandelaPerM2, 0, kMostLight));
  }
  return sky;
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

Lighting readLighting(const JsonPlace& root, const std::filesystem::path& folder, PhotometricFiles& files) {
  Lighting out;
  if (!root.isObject({"version", "comment", "scene", "lamps", "sun", "sky"})) return out;
  if (root.has("version") && root["version"].number(1, 1e6) != 1) root["version"].fail("must be 1");
  if (root.has("comment")) root["comment"].text();
  if (root.has("scene")) out.kept = readKept(root["scene"]);
  if (root.has("lamps")) {
    const JsonPlace lamps = root["lamps"];
    const size_t count = lamps.arraySize();
    if (count > kMostLamps) lamps.fail(fmt::format("more than {} lamps", kMostLamps));
    for (size_t i = 0; i < std::min(count, kMostLamps); ++i) out.lamps.push_back(readLamp(lamps[i], i, folder, files));
  }
  if (root.has("sun")) {
    const JsonPlace sun = root["sun"];
    const size_t count = sun.isArray() ? sun.arraySize() : 1;
    if (count > 16) sun.fail("more than 16 suns");
    for (size_t i = 0; i < std::min<size_t>(count, 16); ++i) out.suns.push_back(readSun(sun.isArray() ? sun[i] : sun));
  }
  if (root.has("sky")) out.sky = readSky(root["sky"], folder);
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

Status applyLightingFile(const std::filesystem::path& file, Scene& scene, std::vector<std::string>* warnings) {
  const Result<nlohmann::json> json = readJsonFile(file);
  if (!json) return Error{json.error()};
  std::string error;
  PhotometricFiles files;
  Lighting lighting = readLighting(JsonPlace(json.value(), "", error), file.parent_path(), files);
  if (!error.empty()) return Error{fmt::format("{}: {}", file.string(), error)};
  if (!emissionStaysInRange(scene, lighting.kept.emission)) {
    return Error{fmt::format("{}: scene.emission: would make a material brighter than 1e12 cd/m2", file.string())};
  }
  apply(lighting, scene);
  if (warnings) warnings->insert(warnings->end(), files.warnings().begin(), files.warnings().end());
  return Ok{};
}

}  // namespace roomlight
