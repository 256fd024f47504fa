#include "optimise/response.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "base/clock.h"
#include "engine/lit_scene.h"
#include "import/lighting_file.h"
#include "measure/glare_meter.h"

namespace roomlight::optimise {
namespace {

using nlohmann::json;

// The study's own lighting file, without daylight: that is the conditions'.
Result<json> fixedLighting(const StudyFile& study) {
  if (study.lightingFile.empty()) return json::object();
  std::ifstream in(study.lightingFile);
  json document = json::parse(in, nullptr, false, true);
  if (!document.is_object()) return Error{fmt::format("{}: is no lighting file", study.lightingFile.string())};
  for (const char* key : {"daylight", "sun", "sky"}) {
    if (document.contains(key)) return Error{fmt::format("{}: {}: daylight belongs into the study's conditions", study.lightingFile.string(), key)};
  }
  // Designs are written elsewhere.
  if (document.contains("lamps") && document["lamps"].is_array()) {
    for (json& lamp : document["lamps"]) {
      if (lamp.is_object() && lamp.contains("file") && lamp["file"].is_string()) lamp["file"] = std::filesystem::absolute(study.lightingFile.parent_path() / lamp["file"].get<std::string>()).lexically_normal().string();
    }
  }
  return document;
}

bool hasLight(const Scene& scene) {
  const bool emits = std::any_of(scene.instances.begin(), scene.instances.end(), [&](const Instance& i) { return !isBlack(scene.materials[static_cast<size_t>(scene.meshes[static_cast<size_t>(i.mesh)].material)].emission); });
  return emits || !scene.lamps.empty() || !scene.suns.empty() || scene.sky.present();
}

MeterSettings metersOf(const ResponseSettings& settings) {
  MeterSettings m;
  m.tolerance = settings.tolerance, m.mostSamples = settings.mostSamples, m.fewestSamples = std::min(128, settings.mostSamples), m.seed = settings.render.seed;
  return m;
}

void readGlare(const Scene& scene, const RayScene& rays, const StudyFile& study, size_t candidate, Response& out) {
  for (size_t e = 0; e < study.eyes.size(); ++e) {
    const Vec3 view = study.eyes[e].direction;
    // The last lamps of the scene are the candidates'.
    const SeenLamp seen = seenLamp(rays, scene.lamps.back(), study.eyes[e].position, view);
    EyeGlare& g = out.glare[candidate * out.eyes + e];
    g.directLux = seen.directLux;
    if (seen.source) g.term = glareTerm({&*seen.source, 1}, view);
  }
}

Status addBase(const Scene& home, const StudyFile& study, const Condition& condition, const Meters& meters, const ResponseSettings& settings, Stages& stages, Response& out) {
  Base base;
  base.lux.assign(meters.elements.size(), {}), base.glare.assign(study.eyes.size(), {});
  const Result<Scene> scene = litBy(home, study, condition.daylight, json::array(), true);
  if (!scene) return Error{scene.error()};
  if (hasLight(scene.value())) {
    const Result<std::unique_ptr<LitScene>> lit = lightScene(scene.value(), settings.render, stages);
    if (!lit) return Error{lit.error()};
    if (!lit.value()) return Ok{};
    const auto readings = stages.run("meters: " + condition.name, [&](const Progress& p) { return lit.value()->illuminance(meters.elements, metersOf(settings), p); });
    for (size_t i = 0; i < readings.size(); ++i) base.lux[i] = readings[i].illuminanceLux;
    for (size_t e = 0; e < study.eyes.size(); ++e) {
      const SeenLamps seen = seenLamps(lit.value()->rays(), study.eyes[e].position, study.eyes[e].direction);
      base.glare[e] = {seen.directLux, glareTerm(seen.sources, study.eyes[e].direction)};
    }
  }
  out.base.push_back(std::move(base));
  return Ok{};
}

// A group of candidates, each a layer of its own.
Status addGroup(const Scene& home, const StudyFile& study, const Candidates& candidates, size_t first, size_t count, const Meters& meters, const ResponseSettings& settings, Stages& stages, Response& out) {
  json lamps = json::array();
  for (size_t c = first; c < first + count; ++c) {
    const Candidate& candidate = candidates.candidates[c];
    json lamp = lampEntry(study.catalogue.luminaires[candidate.luminaire], candidate.position, candidate.direction);
    lamp["group"] = fmt::format("{}", c);
    lamps.push_back(lamp);
  }
  const Result<Scene> scene = litBy(home, study, nullptr, lamps, false);
  if (!scene) return Error{scene.error()};
  RenderSettings render = settings.render;
  render.technique = "hybrid", render.layers = true;
  const Result<std::unique_ptr<LitScene>> lit = lightScene(scene.value(), render, stages);
  if (!lit) return Error{lit.error()};
  if (!lit.value()) return Ok{};
  const LightLayers* layers = lit.value()->layers();
  if (!layers || layers->size() != count) return Error{"candidates could not be told apart: something in the home shines that is neither lamp nor emission"};
  const LayeredReadings readings = stages.run("response", [&](const Progress& p) { return lit.value()->illuminanceInLayers(meters.elements, metersOf(settings), p); });
  if (stages.cancelled()) return Ok{};
  for (size_t l = 0; l < count; ++l) {
    const size_t c = static_cast<size_t>(std::stoul(layers->layers[l].name));
    for (size_t i = 0; i < meters.elements.size(); ++i) out.lux[c * out.elements + i] = readings.at(i, l);
    Scene one;
    one.lamps = {scene.value().lamps[scene.value().lamps.size() - count + (c - first)]};
    readGlare(one, lit.value()->rays(), study, c, out);
  }
  for (size_t i = 0; i < meters.points(); ++i) {
    size_t strongest = 0;
    for (size_t l = 1; l < count; ++l) strongest = luminance(readings.at(i, l)) > luminance(readings.at(i, strongest)) ? l : strongest;
    const float lux = luminance(readings.at(i, strongest));
    if (lux > 0) out.worstErrorPercent = std::max(out.worstErrorPercent, 100 * readings.standardErrorLux[i * readings.layers + strongest] / lux);
  }
  return Ok{};
}

}  // namespace

double glareTerm(std::span<const GlareSource> sources, Vec3 view) {
  double sum = 0;
  for (const GlareSource& s : sources) {
    const double p = positionIndex(s.direction, view);
    if (std::isfinite(p)) sum += s.luminanceCdM2 * s.luminanceCdM2 * s.solidAngleSr / (p * p);
  }
  return sum;
}

Result<json> lightingDocument(const StudyFile& study, const json& daylight, const json& lamps, bool fixedToo) {
  Result<json> fixed = fixedLighting(study);
  if (!fixed) return Error{fixed.error()};
  json document = std::move(fixed.value());
  document["scene"]["suns"] = "off", document["scene"]["sky"] = "off";
  if (!study.ownLamps || !fixedToo) document["scene"]["lamps"] = "off", document["scene"]["emission"] = "off", document.erase("own");
  if (!fixedToo) document.erase("lamps");
  if (!daylight.is_null()) document["daylight"] = daylight;
  for (const json& lamp : lamps) document["lamps"].push_back(lamp);
  return document;
}

Result<Scene> litBy(const Scene& home, const StudyFile& study, const json& daylight, const json& lamps, bool fixedToo) {
  const Result<json> document = lightingDocument(study, daylight, lamps, fixedToo);
  if (!document) return Error{document.error()};
  Scene scene = home;
  if (const Status s = applyLighting(document.value(), study.lightingFile.empty() ? study.file : study.lightingFile, scene); !s) return Error{s.error()};
  return scene;
}

Result<std::optional<Response>> findResponse(const Scene& home, const StudyFile& study, const Candidates& candidates, const Meters& meters, const ResponseSettings& settings, Stages& stages) {
  const Stopwatch watch;
  Response out;
  out.elements = meters.elements.size(), out.eyes = study.eyes.size();
  const size_t n = candidates.candidates.size();
  out.lux.resize(n * out.elements), out.glare.resize(n * out.eyes);
  const size_t groups = (n + settings.atOnce - 1) / settings.atOnce;
  for (size_t g = 0; g < groups; ++g) {
    const size_t first = g * n / groups, end = (g + 1) * n / groups;
    if (const Status s = addGroup(home, study, candidates, first, end - first, meters, settings, stages, out); !s) return Error{s.error()};
    if (stages.cancelled()) return std::optional<Response>();
  }
  out.seconds = watch.seconds();
  for (const Condition& condition : study.conditions) {
    if (const Status s = addBase(home, study, condition, meters, settings, stages, out); !s) return Error{s.error()};
    if (stages.cancelled()) return std::optional<Response>();
  }
  out.baseSeconds = watch.seconds() - out.seconds;
  return std::optional<Response>(std::move(out));
}

}  // namespace roomlight::optimise
