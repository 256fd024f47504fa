#include "optimise/proposal.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fstream>

#include "base/clock.h"
#include "engine/lit_scene.h"
#include "measure/glare_meter.h"

namespace roomlight::optimise {
namespace {

using nlohmann::json;

constexpr double kTolerance = 0.003;  // of the full solution's meters
constexpr int kMostSamples = 1 << 13;

}  // namespace

std::vector<BillLine> billOf(const StudyFile& study, const Candidates& candidates, const Model& model, search::ConstGenome design) {
  std::vector<BillLine> out;
  for (const ChosenLamp& lamp : chosenLamps(model, design)) {
    const LampOption& option = candidates.options[lamp.option];
    const Candidate& c = candidates.candidates[option.candidate];
    const Luminaire& l = study.catalogue.luminaires[c.luminaire];
    BillLine line{l.name, candidates.places[c.place].name, c.position, c.aim, option.kelvin, l.wattsW, l.price, {}};
    for (size_t i = 0; i < model.conditions.size(); ++i) line.dimming.push_back(dimmingOf(model, design, lamp, i));
    out.push_back(std::move(line));
  }
  return out;
}

json lampsOf(const StudyFile& study, const Candidates& candidates, const Model& model, search::ConstGenome design, size_t condition) {
  json lamps = json::array();
  for (const ChosenLamp& lamp : chosenLamps(model, design)) {
    const LampOption& option = candidates.options[lamp.option];
    const Candidate& c = candidates.candidates[option.candidate];
    json entry = lampEntry(study.catalogue.luminaires[c.luminaire], c.position, c.direction);
    entry["name"] = fmt::format("{}: {}", candidates.places[c.place].name, entry["name"].get<std::string>());
    entry["temperature"] = fmt::format("{:g} K", option.kelvin);
    entry["dimming"] = std::round(dimmingOf(model, design, lamp, condition) * 1e6) / 1e6;
    lamps.push_back(std::move(entry));
  }
  return lamps;
}

Result<std::string> lightingFileOf(const StudyFile& study, const json& lamps, const json& daylight) {
  Result<json> document = lightingDocument(study, daylight, lamps, true);
  if (!document) return Error{document.error()};
  document.value()["version"] = 1;
  document.value()["comment"] = "a design by roomlight optimise for " + study.title;
  return document.value().dump(2, ' ', false, json::error_handler_t::replace) + "\n";
}

std::string fileNameOf(const std::string& name) {
  std::string out;
  for (const char c : name) out += std::isalnum(static_cast<unsigned char>(c)) ? static_cast<char>(std::tolower(static_cast<unsigned char>(c))) : '_';
  return out;
}

double Certificate::maxPercent() const {
  double most = 0;
  for (const OfCondition& c : conditions) most = std::max(most, c.maxPercent);
  return most;
}

Result<std::optional<Certificate>> certify(const Scene& home, const StudyFile& study, const Candidates& candidates, const Meters& meters, const Model& model, search::ConstGenome design,
                                           std::span<const Camera> cameras, const RenderSettings& render, Stages& stages) {
  const Stopwatch watch;
  Certificate out;
  MeterSettings tight;
  tight.tolerance = kTolerance, tight.mostSamples = kMostSamples, tight.seed = render.seed + 1;
  const std::span<const SurfaceElement> points = std::span(meters.elements).first(meters.points());
  for (size_t c = 0; c < study.conditions.size(); ++c) {
    const Result<Scene> scene = litBy(home, study, study.conditions[c].daylight, lampsOf(study, candidates, model, design, c), true);
    if (!scene) return Error{scene.error()};
    const Result<std::unique_ptr<LitScene>> lit = lightScene(scene.value(), render, stages);
    if (!lit) return Error{lit.error()};
    if (!lit.value()) return std::optional<Certificate>();
    Certificate::OfCondition r;
    const auto readings = stages.run("certify: " + study.conditions[c].name, [&](const Progress& p) { return lit.value()->illuminance(points, tight, p); });
    for (const MeterReading& m : readings) r.fullLux.push_back(luminance(m.illuminanceLux));
    std::vector<GlarePlan> eyes;
    for (const Eye& e : study.eyes) {
      GlarePlan plan;
      plan.name = e.name, plan.position = e.position, plan.direction = e.direction;
      eyes.push_back(plan);
    }
    std::vector<std::string> ignored;
    for (const GlareReading& g : readGlares(*lit.value(), eyes, MeterSettings(), {}, ignored)) r.fullUgr.push_back(g.ugr.value_or(-1));
    if (stages.cancelled()) return std::optional<Certificate>();
    for (const Camera& camera : c == 0 ? cameras : std::span<const Camera>()) {
      out.pictures.push_back(stages.run("picture", [&](const Progress& p) { return lit.value()->picture(camera, kPictureWidth, kPictureHeight, p); }));
    }
    const std::vector<float> rows = rowsOf(model, design, c);
    for (size_t z = 0; z < model.zones.size(); ++z) {
      const auto lamplit = pointsOf(model.zones[z], rows), base = pointsOf(model.zones[z], {model.baseOf(c), model.rows});
      // Lamps as new: the maintenance factor is of targets.
      for (size_t i = 0; i < lamplit.size(); ++i) r.predictedLux.push_back(base[i] + (lamplit[i] - base[i]) / static_cast<float>(study.maintenance));
    }
    double sum = 0;
    for (size_t i = 0; i < r.fullLux.size(); ++i) {
      if (static_cast<double>(r.fullLux[i]) < kJudgedLux) continue;
      const double off = 100 * std::abs(static_cast<double>(r.predictedLux[i]) / static_cast<double>(r.fullLux[i]) - 1);
      sum += off, r.maxPercent = std::max(r.maxPercent, off), ++r.judged;
    }
    r.meanPercent = r.judged ? sum / static_cast<double>(r.judged) : 0;
    out.conditions.push_back(std::move(r));
  }
  out.seconds = watch.seconds();
  return std::optional<Certificate>(std::move(out));
}

std::vector<size_t> spreadOf(const Model& model, const search::Archive& front, size_t count) {
  const size_t n = front.size(), each = front.objectivesEach;
  std::vector<size_t> open;
  const auto miss = std::find(model.objectives.begin(), model.objectives.end(), Objective::TargetMiss);
  const auto column = static_cast<size_t>(miss - model.objectives.begin());
  double least = std::numeric_limits<double>::infinity();
  for (size_t i = 0; i < n && miss != model.objectives.end(); ++i) least = std::min(least, front.objectivesOf(i)[column]);
  for (size_t i = 0; i < n; ++i) {
    if (miss == model.objectives.end() || front.objectivesOf(i)[column] <= least + kProposedMissPercent) open.push_back(i);
  }
  if (open.empty() || count == 0) return {};
  std::vector<double> low(each, std::numeric_limits<double>::infinity()), high(each, -std::numeric_limits<double>::infinity());
  for (const size_t i : open) {
    for (size_t k = 0; k < each; ++k) low[k] = std::min(low[k], front.objectivesOf(i)[k]), high[k] = std::max(high[k], front.objectivesOf(i)[k]);
  }
  const auto distance = [&](size_t a, size_t b) {
    double sum = 0;
    for (size_t k = 0; k < each; ++k) {
      const double d = (front.objectivesOf(a)[k] - front.objectivesOf(b)[k]) / std::max(high[k] - low[k], 1e-12);
      sum += d * d;
    }
    return sum;
  };
  std::vector<size_t> chosen;
  const auto choose = [&](size_t i) {
    if (chosen.size() < count && std::find(chosen.begin(), chosen.end(), i) == chosen.end()) chosen.push_back(i);
  };
  for (size_t k = 0; k < each; ++k) choose(*std::min_element(open.begin(), open.end(), [&](size_t a, size_t b) { return front.objectivesOf(a)[k] < front.objectivesOf(b)[k]; }));
  while (chosen.size() < std::min(count, open.size())) {
    size_t farthest = open.front();
    double most = -1;
    for (const size_t i : open) {
      double nearest = std::numeric_limits<double>::infinity();
      for (const size_t c : chosen) nearest = std::min(nearest, distance(i, c));
      if (nearest > most) most = nearest, farthest = i;
    }
    if (most <= 0) break;
    choose(farthest);
  }
  std::sort(chosen.begin(), chosen.end(), [&](size_t a, size_t b) { return front.objectivesOf(a)[0] < front.objectivesOf(b)[0]; });
  return chosen;
}

}  // namespace roomlight::optimise
