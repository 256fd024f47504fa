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

EyeGlare glareOf(const Lamp& lamp, const RayScene& rays, const Eye& eye) {
  const SeenLamp seen = seenLamp(rays, lamp, eye.position, eye.direction);
  return {seen.directLux, seen.source ? glareTerm({&*seen.source, 1}, eye.direction) : 0};
}

// Of a condition without candidates. Empty where cancelled.
Result<std::optional<ResponseItem>> findBase(const ResponseProblem& p, const Condition& condition, Stages& stages) {
  ResponseItem base;
  base.lux.assign(p.meters.elements.size(), {}), base.glare.assign(p.study.eyes.size(), {});
  const Result<Scene> scene = litBy(p.home, p.study, condition.daylight, json::array(), true);
  if (!scene) return Error{scene.error()};
  if (hasLight(scene.value())) {
    const Result<std::unique_ptr<LitScene>> lit =
        lightScene(scene.value(), p.settings.render, stages, {.changes = false});
    if (!lit) return Error{lit.error()};
    if (!lit.value()) return std::optional<ResponseItem>();
    const auto readings = stages.run("meters: " + condition.name, [&](const Progress& progress) {
      return lit.value()->illuminance(p.meters.elements, fullMeters(p.settings.render.seed), progress);
    });
    for (size_t i = 0; i < readings.size(); ++i) base.lux[i] = readings[i].illuminanceLux;
    for (size_t e = 0; e < p.study.eyes.size(); ++e) {
      const SeenLamps seen = seenLamps(lit.value()->rays(), p.study.eyes[e].position, p.study.eyes[e].direction);
      base.glare[e] = {seen.directLux, glareTerm(seen.sources, p.study.eyes[e].direction)};
    }
  }
  return stages.cancelled() ? std::optional<ResponseItem>() : std::optional(std::move(base));
}

// Candidates as lamps of a lighting file, each a layer of its own.
json layersOf(const ResponseProblem& p, size_t first, size_t count) {
  json lamps = json::array();
  for (size_t c = first; c < first + count; ++c) {
    const Candidate& candidate = p.candidates.candidates[c];
    json lamp = lampEntry(p.study.catalogue.luminaires[candidate.luminaire], candidate.position, candidate.direction);
    lamp["group"] = fmt::format("{}", c);
    lamps.push_back(lamp);
  }
  return lamps;
}

// Of candidates in one solution. Empty where cancelled.
Result<std::optional<ResponseItem>> findGroup(const ResponseProblem& p, size_t first, size_t count, Stages& stages) {
  const ResponseSizes sizes = sizesOf(p);
  const Result<Scene> scene = litBy(p.home, p.study, nullptr, layersOf(p, first, count), false);
  if (!scene) return Error{scene.error()};
  RenderSettings render = p.settings.render;
  render.technique = technique::kHybrid, render.layers = true;
  const Result<std::unique_ptr<LitScene>> lit = lightScene(scene.value(), render, stages, {.changes = false});
  if (!lit) return Error{lit.error()};
  if (!lit.value()) return std::optional<ResponseItem>();
  const LightLayers* layers = lit.value()->layers();
  if (!layers || layers->size() != count)
    return Error{"candidates could not be told apart: something in the home shines that is neither lamp nor emission"};
  const LayeredReadings readings = stages.run("response", [&](const Progress& progress) {
    return lit.value()->illuminanceInLayers(p.meters.elements, metersOf(p.settings), progress);
  });
  if (stages.cancelled()) return std::optional<ResponseItem>();
  ResponseItem out{first, count, {}, {}, {}};
  out.lux.resize(count * sizes.elements), out.errorsLux.resize(count * sizes.points);
  out.glare.resize(count * sizes.eyes);
  for (size_t l = 0; l < count; ++l) {
    const size_t c = static_cast<size_t>(std::stoul(layers->layers[l].name)) - first;
    for (size_t i = 0; i < sizes.elements; ++i) out.lux[c * sizes.elements + i] = readings.at(i, l);
    for (size_t i = 0; i < sizes.points; ++i)
      out.errorsLux[c * sizes.points + i] = readings.standardErrorLux[i * readings.layers + l];
    // The last lamps of the scene are the candidates'.
    const Lamp& lamp = scene.value().lamps[scene.value().lamps.size() - count + c];
    for (size_t e = 0; e < sizes.eyes; ++e)
      out.glare[c * sizes.eyes + e] = glareOf(lamp, lit.value()->rays(), p.study.eyes[e]);
  }
  return std::optional(std::move(out));
}

// Of candidates that matter at a point, the largest error relative to what they give it.
float worstErrorPercent(const ResponseSizes& sizes, const Response& r, const std::vector<float>& errorsLux) {
  float worst = 0;
  for (size_t i = 0; i < sizes.points; ++i) {
    const auto luxOf = [&](size_t c) { return luminance(r.lux[c * r.elements + i]); };
    float strongest = 0;
    for (size_t c = 0; c < sizes.candidates; ++c) strongest = std::max(strongest, luxOf(c));
    for (size_t c = 0; c < sizes.candidates; ++c) {
      if (strongest > 0 && luxOf(c) >= kThatMatters * strongest)
        worst = std::max(worst, 100 * errorsLux[c * sizes.points + i] / luxOf(c));
    }
  }
  return worst;
}

size_t groupCount(const ResponseProblem& p) {
  return (p.candidates.candidates.size() + p.settings.atOnce - 1) / p.settings.atOnce;
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

ResponseSizes sizesOf(const ResponseProblem& p) {
  return {p.candidates.candidates.size(), p.meters.elements.size(), p.study.eyes.size(), p.study.conditions.size(),
          p.meters.points()};
}

size_t itemCount(const ResponseProblem& p) { return groupCount(p) + p.study.conditions.size(); }

Result<std::optional<ResponseItem>> findItem(const ResponseProblem& p, size_t item, Stages& stages) {
  const size_t groups = groupCount(p), n = p.candidates.candidates.size();
  if (item >= groups) return findBase(p, p.study.conditions[item - groups], stages);
  const size_t first = item * n / groups, end = (item + 1) * n / groups;
  return findGroup(p, first, end - first, stages);
}

Response responseOf(const ResponseSizes& sizes, const std::vector<ResponseItem>& items) {
  Response out;
  out.elements = sizes.elements, out.eyes = sizes.eyes;
  std::vector<float> errorsLux;
  for (const ResponseItem& item : items) {
    if (item.count == 0) {
      out.base.push_back({item.lux, item.glare});
      continue;
    }
    out.lux.insert(out.lux.end(), item.lux.begin(), item.lux.end());
    out.glare.insert(out.glare.end(), item.glare.begin(), item.glare.end());
    errorsLux.insert(errorsLux.end(), item.errorsLux.begin(), item.errorsLux.end());
  }
  out.worstErrorPercent = worstErrorPercent(sizes, out, errorsLux);
  return out;
}

}  // namespace roomlight::optimise
