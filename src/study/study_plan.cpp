// { "version": 1, "comment", "againstPublished": false,
//   "scenes": [ { "name", "scene": "flat.sh3d", "camera": "Kitchen" | 2,
//                 "lights": [ { "name", "lighting": "day.json" | "dimLamp": "150 lm" } ], "walk": "walk.json" } ],
//   "techniques": [ { "name", "technique", "settings": { .. }, "kind": "ours" | "rival" | "judge",
//                     "only": "pictures" | "walks" } ] }
#include "study/study_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>

#include "engine/settings.h"
#include "engine/technique.h"
#include "json/json_file.h"
#include "json/json_reader.h"

namespace roomlight {
namespace {

constexpr size_t kMostEntries = 1000;

std::filesystem::path fileAt(const JsonPlace& j, const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / j.text();
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) j.fail(fmt::format("{}: no such file", file.string()));
  return file;
}

template <class T>
void refuseTwins(const JsonPlace& j, const std::vector<T>& list) {
  std::set<std::string> names;
  for (size_t i = 0; i < list.size(); ++i) {
    if (list[i].name.empty()) j[i]["name"].fail("is empty");
    if (!names.insert(list[i].name).second) j[i]["name"].fail(fmt::format("'{}' is there twice", list[i].name));
  }
}

template <class Read>
auto readList(const JsonPlace& j, Read read) {
  std::vector<decltype(read(j))> list;
  const size_t n = j.arraySize();
  if (n < 1 || n > kMostEntries) {
    j.fail(fmt::format("must have from 1 to {} entries", kMostEntries));
    return list;
  }
  for (size_t i = 0; i < n; ++i) list.push_back(read(j[i]));
  refuseTwins(j, list);
  return list;
}

StudyLight readLight(const JsonPlace& j, const std::filesystem::path& folder) {
  StudyLight light;
  if (!j.isObject({"name", "lighting", "dimLamp"})) return light;
  light.name = j["name"].text();
  if (j.has("lighting") && j.has("dimLamp")) j.fail("give one of lighting, dimLamp");
  if (j.has("lighting")) light.lighting = fileAt(j["lighting"], folder);
  if (j.has("dimLamp")) light.dimLampLm = j["dimLamp"].quantity(Unit::Lumen, 0.01, 1e6);
  return light;
}

// A name, or a number as the file counts them.
std::string readCamera(const JsonPlace& j) {
  if (!j.isNumber()) return j.text();
  const double number = j.number(0, 1e6);
  if (std::floor(number) < number)
    j.fail(fmt::format("{} is no camera; write a whole number from 0 or a name", number));
  return fmt::format("{:.0f}", number);
}

StudyScene readScene(const JsonPlace& j, const std::filesystem::path& folder) {
  StudyScene scene;
  if (!j.isObject({"name", "scene", "camera", "lights", "walk"})) return scene;
  scene.name = j["name"].text();
  scene.file = fileAt(j["scene"], folder);
  if (j.has("camera")) scene.camera = readCamera(j["camera"]);
  scene.lights = readList(j["lights"], [&](const JsonPlace& light) { return readLight(light, folder); });
  if (!scene.lights.empty()) scene.walkLight = scene.lights.front();
  if (j.has("walk")) scene.walk = fileAt(j["walk"], folder);
  return scene;
}

std::string kindOf(const Technique& t) {
  return t.role == TechniqueRole::Judge ? "judge" : t.role == TechniqueRole::Rival ? "rival" : "ours";
}

StudyTechnique readTechnique(const JsonPlace& j) {
  StudyTechnique t;
  if (!j.isObject({"name", "technique", "settings", "kind", "only"})) return t;
  t.name = j["name"].text();
  t.technique = j["technique"].text();
  if (!findTechnique(t.technique)) j["technique"].fail(fmt::format("unknown technique '{}'", t.technique));
  if (j.has("kind")) t.kind = j["kind"].oneOf({"ours", "rival", "judge"});
  if (j.has("only")) t.only = j["only"].oneOf({"pictures", "walks"});
  if (j.has("settings")) {
    t.settings = j["settings"].json();
    const Result<RenderSettings> read = settingsFromJson(t.settings, j["settings"].path());
    if (!read) j["settings"].fail(read.error());
  }
  return t;
}

}  // namespace

std::vector<StudyTechnique> StudyPlan::techniquesIn(const std::string& what) const {
  std::vector<StudyTechnique> out;
  std::copy_if(techniques.begin(), techniques.end(), std::back_inserter(out),
               [&](const StudyTechnique& t) { return t.only.empty() || t.only == what; });
  return out;
}

std::string viewName(const StudyScene& scene, const StudyLight& light) { return scene.name + "/" + light.name; }

std::string walkName(const StudyScene& scene) { return scene.name + "/walk"; }

std::vector<std::string> partsOf(const StudyPlan& plan) {
  std::vector<std::string> names;
  const bool views = !plan.techniquesIn("pictures").empty(), walks = !plan.techniquesIn("walks").empty();
  for (const StudyScene& s : plan.scenes) {
    for (const StudyLight& light : s.lights) {
      if (views) names.push_back(viewName(s, light));
    }
    if (walks && !s.walk.empty()) names.push_back(walkName(s));
  }
  return names;
}

std::vector<StudyTechnique> usualTechniques() {
  namespace t = technique;
  std::vector<StudyTechnique> out = {
      {t::kCone, t::kCone},
      {t::kHybrid, t::kHybrid},
      {"hybrid, draft", t::kHybrid, R"({"quality": "draft"})"},
      {"hybrid, walking", t::kHybrid, R"({"quality": "draft", "frames": {"quickMs": 33}})", "", "walks"},
      {t::kVxgi, t::kVxgi},
      {t::kLpv, t::kLpv},
      {"lpv, 256 steps", t::kLpv, R"({"lpv": {"steps": 256}})"},
      {t::kPhoton, t::kPhoton},
      {"photon, no gathering", t::kPhoton, R"({"photon": {"finalGather": 0}})"},
      {t::kPath, t::kPath},
      {"path, filtered", t::kPath, R"({"path": {"filter": true}})"}};
  for (StudyTechnique& row : out) row.kind = kindOf(*findTechnique(row.technique));
  return out;
}

Result<StudyPlan> readStudyFile(const std::filesystem::path& file) {
  const Result<nlohmann::json> document = readJsonFile(file);
  if (!document) return Error{document.error()};
  std::string error;
  const JsonPlace j(document.value(), "", error);
  const std::filesystem::path folder = file.parent_path();
  StudyPlan plan;
  if (j.isObject({"version", "comment", "againstPublished", "scenes", "techniques"})) {
    if (j.has("version") && j["version"].number(1, 1e6) != 1) j["version"].fail("must be 1");
    if (j.has("comment")) j["comment"].text();
    if (j.has("againstPublished")) plan.againstPublished = j["againstPublished"].flag();
    plan.scenes = readList(j["scenes"], [&](const JsonPlace& scene) { return readScene(scene, folder); });
    plan.techniques = j.has("techniques") ? readList(j["techniques"], readTechnique) : usualTechniques();
  }
  if (!error.empty()) return Error{fmt::format("{}: {}", file.string(), error)};
  return plan;
}

}  // namespace roomlight
