#include "optimise/response.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "base/progress.h"
#include "engine/lit_scene.h"
#include "import/lighting_file.h"
#include "measure/glare.h"
#include "engine/settings.h"

namespace roomlight::optimise {
namespace {

using nlohmann::json;

constexpr float kThatMatters = 0.1f;  // of the strongest candidate at a point

// The study's own lighting file, without daylight: that is the conditions'.
Result<json> fixedLighting(const StudyFile& study) {
  if (study.lightingFile.empty()) return json::object();
  std::ifstream in(study.lightingFile);
  json document = json::parse(in, nullptr, false, true);
  if (!document.is_object()) return Error{fmt::format("{}: is no lighting file", study.lightingFile.string())};
  for (const char* key : {"daylight", "sun", "sky"}) {
    if (document.contains(key))
      return Error{
          fmt::format("{}: {}: daylight belongs into the study's conditions", study.lightingFile.string(), key)};
  }
  if (document.contains("scene") && !document["scene"].is_object())
    return Error{fmt::format("{}: scene: must be an object", study.lightingFile.string())};
  if (document.contains("lamps") && !document["lamps"].is_array())
    return Error{fmt::format("{}: lamps: must be a list", study.lightingFile.string())};
  // Designs are written elsewhere.
  if (document.contains("lamps")) {
    for (json& lamp : document["lamps"]) {
      if (lamp.is_object() && lamp.contains("file") && lamp["file"].is_string())
        lamp["file"] = std::filesystem::absolute(study.lightingFile.parent_path() / lamp["file"].get<std::string>())
                           .lexically_normal()
                           .string();
    }
  }
  return document;
}

bool hasLight(const Scene& scene) {
  const bool emits = std::any_of(scene.instances.begin(), scene.instances.end(), [&](const Instance& i) {
    return !isBlack(scene.materials[static_cast<size_t>(scene.meshes[static_cast<size_t>(i.mesh)].material)].emission);
  });
  return emits || !scene.lamps.empty() || !scene.suns.empty() || scene.sky.present();
}

MeterSettings metersOf(const ResponseSettings& settings) {
  MeterSettings m;
  m.tolerance = settings.tolerance, m.mostSamples = settings.mostSamples,
  m.fewestSamples = std::min(settings.fewestSamples, settings.mostSamples), m.seed = settings.render.seed;
  return m;
}

// All that the response is found from, and what is found.
struct Task {
  const Scene& home;
  const StudyFile& study;
  const Candidates& candidates;
  const Meters& meters;
  const ResponseSettings& settings;
  Stages& stages;
  Response out;
  std::vector<float> errorsLux;  // standard errors of candidate c at point i: errorsLux[c * points + i]
};

EyeGlare glareOf(const Lamp& lamp, const RayScene& rays, const Eye& eye) {
  const SeenLamp seen = seenLamp(rays, lamp, eye.position, eye.direction);
  return {seen.directLux, seen.source ? glareTerm({&*seen.source, 1}, eye.direction) : 0};
}

Status addBase(Task& t, const Condition& condition) {
  Base base;
  base.lux.assign(t.meters.elements.size(), {}), base.glare.assign(t.study.eyes.size(), {});
  const Result<Scene> scene = litBy(t.home, t.study, condition.daylight, json::array(), true);
  if (!scene) return Error{scene.error()};
  if (hasLight(scene.value())) {
    const Result<std::unique_ptr<LitScene>> lit =
        lightScene(scene.value(), t.settings.render, t.stages, {.changes = false});
    if (!lit) return Error{lit.error()};
    if (!lit.value()) return Ok{};
    const auto readings = t.stages.run("meters: " + condition.name, [&](const Progress& p) {
      return lit.value()->illuminance(t.meters.elements, fullMeters(t.settings.render.seed), p);
    });
    for (size_t i = 0; i < readings.size(); ++i) base.lux[i] = readings[i].illuminanceLux;
    for (size_t e = 0; e < t.study.eyes.size(); ++e) {
      const SeenLamps seen = seenLamps(lit.value()->rays(), t.study.eyes[e].position, t.study.eyes[e].direction);
      base.glare[e] = {seen.directLux, glareTerm(seen.sources, t.study.eyes[e].direction)};
    }
  }
  t.out.base.push_back(std::move(base));
  return Ok{};
}

// Candidates as lamps of a lighting file, each a layer of its own.
json layersOf(const Task& t, size_t first, size_t count) {
  json lamps = json::array();
  for (size_t c = first; c < first + count; ++c) {
    const Candidate& candidate = t.candidates.candidates[c];
    json lamp = lampEntry(t.study.catalogue.luminaires[candidate.luminaire], candidate.position, candidate.direction);
    lamp["group"] = fmt::format("{}", c);
    lamps.push_back(lamp);
  }
  return lamps;
}

// A group of candidates in one solution.
Status addGroup(Task& t, size_t first, size_t count) {
  const Result<Scene> scene = litBy(t.home, t.study, nullptr, layersOf(t, first, count), false);
  if (!scene) return Error{scene.error()};
  RenderSettings render = t.settings.render;
  render.technique = technique::kHybrid, render.layers = true;
  const Result<std::unique_ptr<LitScene>> lit = lightScene(scene.value(), render, t.stages, {.changes = false});
  if (!lit) return Error{lit.error()};
  if (!lit.value()) return Ok{};
  const LightLayers* layers = lit.value()->layers();
  if (!layers || layers->size() != count)
    return Error{"candidates could not be told apart: something in the home shines that is neither lamp nor emission"};
  const LayeredReadings readings = t.stages.run("response", [&](const Progress& p) {
    return lit.value()->illuminanceInLayers(t.meters.elements, metersOf(t.settings), p);
  });
  if (t.stages.cancelled()) return Ok{};
  for (size_t l = 0; l < count; ++l) {
    const size_t c = static_cast<size_t>(std::stoul(layers->layers[l].name));
    for (size_t i = 0; i < t.out.elements; ++i) t.out.lux[c * t.out.elements + i] = readings.at(i, l);
    for (size_t i = 0; i < t.meters.points(); ++i)
      t.errorsLux[c * t.meters.points() + i] = readings.standardErrorLux[i * readings.layers + l];
    // The last lamps of the scene are the candidates'.
    const Lamp& lamp = scene.value().lamps[scene.value().lamps.size() - count + (c - first)];
    for (size_t e = 0; e < t.out.eyes; ++e)
      t.out.glare[c * t.out.eyes + e] = glareOf(lamp, lit.value()->rays(), t.study.eyes[e]);
  }
  return Ok{};
}

// Of candidates that matter at a point, the largest error relative to what they give it.
float worstErrorPercent(const Task& t) {
  const size_t n = t.candidates.candidates.size(), points = t.meters.points();
  float worst = 0;
  for (size_t i = 0; i < points; ++i) {
    const auto luxOf = [&](size_t c) { return luminance(t.out.lux[c * t.out.elements + i]); };
    float strongest = 0;
    for (size_t c = 0; c < n; ++c) strongest = std::max(strongest, luxOf(c));
    for (size_t c = 0; c < n; ++c) {
      if (strongest > 0 && luxOf(c) >= kThatMatters * strongest)
        worst = std::max(worst, 100 * t.errorsLux[c * points + i] / luxOf(c));
    }
  }
  return worst;
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
  if (!study.ownLamps || !fixedToo)
    document["scene"]["lamps"] = "off", document["scene"]["emission"] = "off", document.erase("own");
  if (!fixedToo) document.erase("lamps");
  if (!daylight.is_null()) document["daylight"] = daylight;
  for (const json& lamp : lamps) document["lamps"].push_back(lamp);
  return document;
}

Result<Scene> litBy(const Scene& home, const StudyFile& study, const json& daylight, const json& lamps, bool fixedToo) {
  const Result<json> document = lightingDocument(study, daylight, lamps, fixedToo);
  if (!document) return Error{document.error()};
  Scene scene = home;
  if (const Status s =
          applyLighting(document.value(), study.lightingFile.empty() ? study.file : study.lightingFile, scene);
      !s)
    return Error{s.error()};
  return scene;
}

Status checkConditions(const Scene& home, const StudyFile& study) {
  if (const Result<Scene> fixed = litBy(home, study, nullptr, json::array(), true); !fixed) return Error{fixed.error()};
  for (const Condition& c : study.conditions) {
    if (c.daylight.is_null()) continue;
    Scene scene = home;
    json document = json::object();
    document["daylight"] = c.daylight;
    const Status applied = applyLighting(document, study.file, scene);
    if (applied) continue;
    // It begins with the file; the line goes behind that.
    const std::string file = study.file.string() + ": ", what = applied.error();
    return Error{fmt::format("{}:{}: condition '{}': {}", study.file.string(), c.line, c.name,
                             what.starts_with(file) ? what.substr(file.size()) : what)};
  }
  return Ok{};
}

Result<std::optional<Response>> findResponse(const Scene& home, const StudyFile& study, const Candidates& candidates,
                                             const Meters& meters, const ResponseSettings& settings, Stages& stages) {
  const Stopwatch watch;
  Task t{home, study, candidates, meters, settings, stages, {}, {}};
  const size_t n = candidates.candidates.size();
  t.out.elements = meters.elements.size(), t.out.eyes = study.eyes.size();
  t.out.lux.resize(n * t.out.elements), t.out.glare.resize(n * t.out.eyes), t.errorsLux.resize(n * meters.points());
  const size_t groups = (n + settings.atOnce - 1) / settings.atOnce;
  for (size_t g = 0; g < groups; ++g) {
    const size_t first = g * n / groups, end = (g + 1) * n / groups;
    if (const Status s = addGroup(t, first, end - first); !s) return Error{s.error()};
    if (stages.cancelled()) return std::optional<Response>();
  }
  t.out.worstErrorPercent = worstErrorPercent(t);
  t.out.seconds = watch.seconds();
  for (const Condition& condition : study.conditions) {
    if (const Status s = addBase(t, condition); !s) return Error{s.error()};
    if (stages.cancelled()) return std::optional<Response>();
  }
  t.out.baseSeconds = watch.seconds() - t.out.seconds;
  return std::optional<Response>(std::move(t.out));
}

}  // namespace roomlight::optimise
