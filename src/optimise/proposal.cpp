#include "optimise/proposal.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fstream>

#include "base/progress.h"
#include "look/display.h"
#include "engine/sights.h"
#include "engine/lit_scene.h"
#include "measure/glare.h"

namespace roomlight::optimise {
namespace {

using nlohmann::json;

std::string fileNameOf(const std::string& name) {
  std::string out;
  for (const char c : name)
    out += std::isalnum(static_cast<unsigned char>(c)) ? static_cast<char>(std::tolower(static_cast<unsigned char>(c)))
                                                       : '_';
  return out;
}

// Of base light and what lamps as new add to it, the sum with the maintenance factor.
float maintained(float base, float all, double maintenance) {
  return base + (all - base) * static_cast<float>(maintenance);
}

// UGR of the full solution with lamps' light times the maintenance factor; below 0: there is none.
double maintainedUgr(const StudyFile& study, const Model& m, const GlareReading& g, size_t condition, size_t eye) {
  if (!g.ugr) return -1;
  if (study.maintenance >= 1 || *g.ugr <= 0) return *g.ugr;
  const double f = study.maintenance, glare = glareOfUgr(*g.ugr) * g.backgroundCdM2,
               base = m.baseGlare[condition * m.eyes.size() + eye];
  const double background =
      static_cast<double>(maintained(m.baseOf(condition)[m.firstEye + eye], static_cast<float>(g.backgroundCdM2), f));
  return ugrOf(base + (glare - base) * f * f, background);
}

std::vector<double> ugrsOf(const LitScene& lit, const StudyFile& study, const Model& model, size_t condition) {
  std::vector<GlarePlan> eyes;
  for (const Eye& e : study.eyes) {
    GlarePlan plan;
    plan.name = e.name, plan.position = e.position, plan.direction = e.direction;
    eyes.push_back(plan);
  }
  std::vector<std::string> ignored;
  std::vector<double> out;
  for (const GlareReading& g : readGlares(lit, eyes, MeterSettings(), {}, ignored))
    out.push_back(maintainedUgr(study, model, g, condition, out.size()));
  return out;
}

// Lamps as new: the maintenance factor is of targets.
std::vector<float> predictedLux(const Design& design, size_t condition) {
  std::vector<float> out;
  const Model& model = design.model;
  const std::vector<float> rows = rowsOf(model, design.genome, condition);
  for (const ModelZone& z : model.zones) {
    const auto lamplit = pointsOf(z, rows), base = pointsOf(z, {model.baseOf(condition), model.rows});
    for (size_t i = 0; i < lamplit.size(); ++i)
      out.push_back(maintained(base[i], lamplit[i], 1 / design.study.maintenance));
  }
  return out;
}

void compare(Certificate::OfCondition& r) {
  double sum = 0;
  for (size_t i = 0; i < r.fullLux.size(); ++i) {
    const auto full = static_cast<double>(r.fullLux[i]);
    if (full < kJudgedLux) continue;
    const double off = 100 * std::abs(static_cast<double>(r.predictedLux[i]) / full - 1);
    if (off >= r.maxPercent)
      r.maxPercent = off, r.uncertainPercent = 100 * static_cast<double>(r.fullErrorLux[i]) / full;
    sum += off, ++r.judged;
  }
  r.meanPercent = r.judged ? sum / static_cast<double>(r.judged) : 0;
}

// As `roomlight render` shows it.
Image shown(const Image& light, const Camera& camera, const RayScene& rays) {
  const Display display = usualDisplay();
  return displayed(light, display, whiteOf(display, lightColour(rays, camera, light)), ev100Of(display, light));
}

}  // namespace

std::vector<BillLine> billOf(const Design& design) {
  std::vector<BillLine> out;
  const Candidates& candidates = design.candidates;
  for (const ChosenLamp& lamp : chosenLamps(design.model, design.genome)) {
    const LampOption& option = candidates.options[lamp.option];
    const Candidate& c = candidates.candidates[option.candidate];
    const Luminaire& l = design.study.catalogue.luminaires[c.luminaire];
    BillLine line{l.name, candidates.places[c.place].name, c.position, c.aim, option.kelvin, l.wattsW, l.price, {}};
    for (size_t i = 0; i < design.model.conditions.size(); ++i)
      line.dimming.push_back(dimmingOf(design.model, design.genome, lamp, i));
    out.push_back(std::move(line));
  }
  return out;
}

json lampsOf(const Design& design, size_t condition) {
  json lamps = json::array();
  const Candidates& candidates = design.candidates;
  for (const ChosenLamp& lamp : chosenLamps(design.model, design.genome)) {
    const LampOption& option = candidates.options[lamp.option];
    const Candidate& c = candidates.candidates[option.candidate];
    json entry = lampEntry(design.study.catalogue.luminaires[c.luminaire], c.position, c.direction);
    entry["name"] = fmt::format("{}: {}", candidates.places[c.place].name, entry["name"].get<std::string>());
    entry["temperature"] = fmt::format("{:g} K", option.kelvin);
    entry["dimming"] = std::round(dimmingOf(design.model, design.genome, lamp, condition) * 1e6) / 1e6;
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

std::vector<std::string> fileNamesOf(const std::vector<Condition>& conditions) {
  std::vector<std::string> out;
  for (const Condition& c : conditions) {
    const std::string plain = fileNameOf(c.name);
    std::string name = plain;
    for (int number = 2; std::find(out.begin(), out.end(), name) != out.end(); ++number)
      name = fmt::format("{}_{}", plain, number);
    out.push_back(name);
  }
  return out;
}

const Certificate::OfCondition& Certificate::worst() const {
  return *std::max_element(conditions.begin(), conditions.end(),
                           [](const OfCondition& a, const OfCondition& b) { return a.maxPercent < b.maxPercent; });
}

std::string largestDifference(const Certificate::OfCondition& c) {
  return fmt::format("largest {:.2f} % (full solution uncertain by {:.2f} % there)", c.maxPercent, c.uncertainPercent);
}

std::vector<float> maintainedLux(const StudyFile& study, const Model& model, const Certificate::OfCondition& c,
                                 size_t condition) {
  std::vector<float> out;
  for (const ModelZone& z : model.zones) {
    for (const float base : pointsOf(z, {model.baseOf(condition), model.rows}))
      out.push_back(maintained(base, c.fullLux[out.size()], study.maintenance));
  }
  return out;
}

Result<std::optional<Certificate>> certify(const Scene& home, const Design& design, const Meters& meters,
                                           std::span<const Camera> cameras, const RenderSettings& render,
                                           Stages& stages) {
  const Stopwatch watch;
  const StudyFile& study = design.study;
  Certificate out;
  const std::span<const SurfaceElement> points = std::span(meters.elements).first(meters.points());
  for (size_t c = 0; c < study.conditions.size(); ++c) {
    const Result<Scene> scene = litBy(home, study, study.conditions[c].daylight, lampsOf(design, c), true);
    if (!scene) return Error{scene.error()};
    const Result<std::unique_ptr<LitScene>> lit = lightScene(scene.value(), render, stages, {.changes = false});
    if (!lit) return Error{lit.error()};
    if (!lit.value()) return std::optional<Certificate>();
    Certificate::OfCondition r;
    // Other random numbers than those the response was found with.
    const auto readings = stages.run("certify: " + study.conditions[c].name, [&](const Progress& p) {
      return lit.value()->illuminance(points, fullMeters(render.seed + 1), p);
    });
    for (const MeterReading& m : readings)
      r.fullLux.push_back(luminance(m.illuminanceLux)),
          r.fullErrorLux.push_back(static_cast<float>(m.standardErrorLux));
    r.fullUgr = ugrsOf(*lit.value(), study, design.model, c);
    if (stages.cancelled()) return std::optional<Certificate>();
    for (const Camera& camera : c == 0 ? cameras : std::span<const Camera>()) {
      const Image light = stages.run(
          "picture", [&](const Progress& p) { return lit.value()->picture(camera, kPictureWidth, kPictureHeight, p); });
      if (light.width > 0) out.pictures.push_back(shown(light, camera, lit.value()->rays()));
    }
    r.predictedLux = predictedLux(design, c);
    compare(r);
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
  for (size_t i = 0; i < n && miss != model.objectives.end(); ++i)
    least = std::min(least, front.objectivesOf(i)[column]);
  for (size_t i = 0; i < n; ++i) {
    if (miss == model.objectives.end() || front.objectivesOf(i)[column] <= least + kProposedMissPercent)
      open.push_back(i);
  }
  if (open.empty() || count == 0) return {};
  std::vector<double> low(each, std::numeric_limits<double>::infinity()),
      high(each, -std::numeric_limits<double>::infinity());
  for (const size_t i : open) {
    for (size_t k = 0; k < each; ++k)
      low[k] = std::min(low[k], front.objectivesOf(i)[k]), high[k] = std::max(high[k], front.objectivesOf(i)[k]);
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
  for (size_t k = 0; k < each; ++k)
    choose(*std::min_element(open.begin(), open.end(),
                             [&](size_t a, size_t b) { return front.objectivesOf(a)[k] < front.objectivesOf(b)[k]; }));
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
  std::sort(chosen.begin(), chosen.end(),
            [&](size_t a, size_t b) { return front.objectivesOf(a)[0] < front.objectivesOf(b)[0]; });
  return chosen;
}

}  // namespace roomlight::optimise
