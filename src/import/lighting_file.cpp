// Lighting files, version 1 (docs/reference/lighting.md):
//   { "scene": { "lamps": "keep"|"off", "suns": .., "sky": .., "emission": "keep"|"off"|factor },
//     "lamps": [ { "type": "point"|"spot"|"area"|"photometric", "position": [x,y,z], "flux"|"intensity"|"luminance":
//     "800 lm", .. } ], "sun": { "direction": [x,y,z], "illuminance": "75000 lx" } or { "latitude", "longitude", "time"
//     } or a list of them, "sky": { "luminance": "3000 cd/m2" } or { "image": "sky.hdr", "unit": "1000 cd/m2" |
//     "horizontalIlluminance": "10 klx" }, "daylight": { "sky": "clear"|"intermediate"|"overcast"|1..16|"perez",
//     "latitude", "longitude", "time", .. }, "own": [ { "name", "number", "dimming": 0..1, "factor", .. } ],
//     "metresPerUnit": number, the scene's unit that places are meant for (home/open_home),
//     "ground": { "elevation": y, "centre": [x,z], "radius": r, "reflectance": 0..1 },
//     "glazing": [ { "material": "Glass", "panes": 2, "internalTransmittance": 0.96, "ior": 1.52 } ] }
#include "import/lighting_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "import/lighting_daylight.h"
#include "import/lighting_lamps.h"
#include "import/lighting_surfaces.h"
#include "import/lighting_values.h"
#include "json/json_file.h"

namespace roomlight {
namespace {

using importers::PhotometricFiles;
using importers::readLamp;

constexpr size_t kMostLamps = 100'000;

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
  std::optional<Ground> ground;
  std::vector<GlazedMaterial> glazing;
  std::vector<OwnLamp> own;
  std::vector<std::string> warnings;
};

Lighting readLighting(const JsonPlace& root, const std::filesystem::path& folder, PhotometricFiles& files) {
  Lighting out;
  if (!root.isObject({"version", "comment", "scene", "lamps", "sun", "sky", "daylight", "ground", "glazing", "own",
                      "metresPerUnit"}))
    return out;
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
  if (root.has("daylight")) {
    forbid(root, {"sun", "sky"}, "beside 'daylight', which brings both");
    Daylight daylight = readDaylight(root["daylight"], folder);
    if (isBlack(daylight.sun.illuminanceLux) && !daylight.sky.present())
      out.warnings.push_back("daylight: the sun is below the horizon then; there is none");
    out.suns.push_back(daylight.sun);
    out.sky = std::move(daylight.sky);
  }
  if (root.has("metresPerUnit")) root["metresPerUnit"].number(1e-9, 1e6);
  if (root.has("ground")) out.ground = readGround(root["ground"]);
  if (root.has("glazing")) out.glazing = readGlazing(root["glazing"]);
  if (root.has("own")) out.own = readOwnLamps(root["own"]);
  return out;
}

// Depends on the scene: its emission times the factor must stay in range.
bool emissionStaysInRange(const Scene& scene, float factor) {
  return std::all_of(scene.materials.begin(), scene.materials.end(),
                     [&](const Material& m) { return factor <= 1 || maxComponent(m.emission) <= kMostLight / factor; });
}

void apply(Lighting& lighting, Scene& scene) {
  const Kept& kept = lighting.kept;
  applyOwnLamps(lighting.own, scene);  // while they are all there
  if (!kept.lamps) std::erase_if(scene.lamps, [](const Lamp& l) { return l.kind != LampKind::Area; });
  if (!kept.suns) scene.suns.clear();
  if (!kept.sky) scene.sky = {};
  for (Material& m : scene.materials) m.emission *= kept.emission;
  applyGlazing(lighting.glazing, scene);
  const size_t first = scene.lamps.size();
  scene.lamps.insert(scene.lamps.end(), lighting.lamps.begin(), lighting.lamps.end());
  addAreaLampMeshes(scene, first);
  if (lighting.ground) addGround(*lighting.ground, scene);
  for (const Sun& sun : lighting.suns) {
    if (!isBlack(sun.illuminanceLux)) scene.suns.push_back(sun);
  }
  if (lighting.sky) scene.sky = std::move(*lighting.sky);
}

}  // namespace

Status applyLightingFile(const std::filesystem::path& file, Scene& scene, std::vector<std::string>* warnings) {
  const Result<nlohmann::json> json = readJsonFile(file);
  if (!json) return Error{json.error()};
  return applyLighting(json.value(), file, scene, warnings);
}

Status applyLighting(const nlohmann::json& document, const std::filesystem::path& file, Scene& scene,
                     std::vector<std::string>* warnings) {
  std::string error;
  PhotometricFiles files;
  Lighting lighting = readLighting(JsonPlace(document, "", error), file.parent_path(), files);
  if (!error.empty()) return Error{fmt::format("{}: {}", file.string(), error)};
  if (!emissionStaysInRange(scene, lighting.kept.emission)) {
    return Error{fmt::format("{}: scene.emission: would make a material brighter than 1e12 cd/m2", file.string())};
  }
  if (const std::string wrong = missingLamp(lighting.own, scene); !wrong.empty())
    return Error{fmt::format("{}: {}", file.string(), wrong)};
  if (const std::string wrong = missingMaterial(lighting.glazing, scene); !wrong.empty())
    return Error{fmt::format("{}: {}", file.string(), wrong)};
  apply(lighting, scene);
  if (warnings) {
    warnings->insert(warnings->end(), lighting.warnings.begin(), lighting.warnings.end());
    warnings->insert(warnings->end(), files.warnings().begin(), files.warnings().end());
  }
  return Ok{};
}

}  // namespace roomlight
