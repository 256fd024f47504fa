#include "validate/validation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "engine/technique.h"
#include "validate/cases.h"
#include "validate/glare_tables.h"

namespace roomlight {
namespace {

constexpr double kNextToNothing = 0.01;
constexpr const char* kGlareCase = "UGR";
constexpr size_t kGlareSteps = 10;
constexpr double kMeterTolerance = 0.002,
                 kBriefTolerance = 0.005;  // relative standard error of one reading, where it is a value by itself

std::vector<MakeCase> allCases() {
  std::vector<MakeCase> out;
  for (const auto* group : {&closedFormCases(), &lampCases(), &daylightCases()})
    out.insert(out.end(), group->begin(), group->end());
  return out;
}

// Values that are means over many readings need less of each, small differences of large ones more.
MeterSettings meterSettings(const ValidationCase& of, bool brief, uint64_t seed) {
  size_t fewest = of.quantities.front().elements.size();
  double smallest = 1;
  for (const Quantity& q : of.quantities) {
    fewest = std::min(fewest, q.elements.size());
    if (q.offset != 0)
      smallest = std::min(smallest, std::abs(q.expected) / (std::abs(q.expected) + std::abs(q.offset)));
  }
  MeterSettings meter;
  meter.tolerance = (brief ? kBriefTolerance : kMeterTolerance) * std::sqrt(static_cast<double>(fewest)) * smallest;
  meter.fewestSamples = fewest > 1 ? 16 : 256;
  meter.mostSamples = 1 << 18;
  meter.seed = seed;
  return meter;
}

std::vector<double> values(const ValidationCase& of, const LitScene& lit, const ValidationSettings& settings,
                           const Progress& progress) {
  std::vector<SurfaceElement> elements;
  for (const Quantity& q : of.quantities) elements.insert(elements.end(), q.elements.begin(), q.elements.end());
  Progress quiet;
  quiet.cancelled = progress.cancelled;
  const std::vector<MeterReading> readings =
      lit.illuminance(elements, meterSettings(of, settings.brief, settings.render.seed), quiet);
  std::vector<double> out;
  size_t next = 0;
  for (const Quantity& q : of.quantities) {
    double value = q.offset;
    for (const double w : q.weights) value += w * static_cast<double>(luminance(readings[next++].illuminanceLux));
    out.push_back(value);
  }
  return out;
}

// Rows of one case and technique.
std::vector<ValidationRow> judged(const ValidationCase& of, const std::string& technique,
                                  const std::vector<double>& got) {
  double largest = 0, all = 0, sum = 0;
  for (size_t i = 0; i < got.size(); ++i)
    largest = std::max(largest, std::abs(of.quantities[i].expected)), all += of.quantities[i].expected, sum += got[i];
  const MeterAccuracy& asked = findTechnique(technique)->meters;
  const double allowed = asked.allowedPercent, total = all != 0 ? 100 * (sum / all - 1) : 0;
  std::vector<ValidationRow> rows;
  for (size_t i = 0; i < got.size(); ++i) {
    const Quantity& q = of.quantities[i];
    const double error = 100 * (got[i] - q.expected) / std::max(std::abs(q.expected), kNextToNothing * largest);
    rows.push_back({of.name, of.title, of.unit, of.basis, q.place, technique, q.expected, got[i], error, "%",
                    std::abs(asked.ofSum ? total : error) <= allowed});
  }
  return rows;
}

// A case of those wanted, or none of its quantities.
ValidationCase chosen(ValidationCase of, const ValidationSettings& settings) {
  std::vector<Quantity> some;
  const bool wanted = of.name.find(settings.only) != std::string::npos;
  for (size_t i = 0; i < of.quantities.size() && wanted; i += settings.brief ? 3 : 1)
    some.push_back(std::move(of.quantities[i]));
  of.quantities = std::move(some);
  return of;
}

Result<std::vector<ValidationRow>> measured(const ValidationCase& of, const std::string& technique,
                                            const ValidationSettings& settings, const Progress& progress) {
  RenderSettings render = settings.render;
  render.technique = technique;
  RenderStats stats;
  RenderProgress quiet;
  quiet.cancelled = progress.cancelled;
  Stages stages(quiet, stats);
  const Result<std::unique_ptr<LitScene>> lit = lightScene(of.scene, render, stages, {.changes = false});
  if (!lit) return Error{lit.error()};
  if (progress.stop()) return std::vector<ValidationRow>();
  return judged(of, technique, values(of, *lit.value(), settings, progress));
}

ValidationSummary summary(const std::vector<ValidationRow>& rows, const std::string& technique) {
  const MeterAccuracy& asked = findTechnique(technique)->meters;
  ValidationSummary out{technique, asked.allowedPercent, asked.ofSum, 0, "", 0, 0};
  for (const ValidationRow& r : rows) {
    if (r.technique != technique) continue;
    ++out.places, out.passed += r.pass;
    if (r.errorUnit == "%" && std::abs(r.error) > std::abs(out.worstPercent))
      out.worstPercent = r.error, out.worstPlace = r.name + ", " + r.place;
  }
  return out;
}

}  // namespace

std::vector<std::string> validatedTechniques() {
  std::vector<std::string> names;
  for (const bool judge : {true, false}) {
    for (const Technique* t : techniques()) {
      if (t->meters.isValidated && (t->role == TechniqueRole::Judge) == judge) names.emplace_back(t->name);
    }
  }
  return names;
}

bool Validation::pass() const {
  return std::all_of(rows.begin(), rows.end(), [](const ValidationRow& r) { return r.pass; });
}

Result<Validation> validateTechniques(const ValidationSettings& settings, const Progress& progress) {
  for (const std::string& technique : settings.techniques) {
    if (const auto known = techniqueNamed(technique); !known) return Error{known.error()};
  }
  Validation out;
  const std::vector<MakeCase> cases = allCases();
  const bool glare = std::string(kGlareCase).find(settings.only) != std::string::npos;
  // A table of glare ratings takes about as long as so many cases.
  const size_t steps = (cases.size() + (glare ? kGlareSteps : 0)) * settings.techniques.size();
  size_t done = 0;
  const auto step = [&](size_t n) { progress.at(static_cast<float>(done += n) / static_cast<float>(steps)); };
  for (const MakeCase make : cases) {
    const ValidationCase of = chosen(make(), settings);
    for (const std::string& technique : settings.techniques) {
      if (!of.quantities.empty() && !progress.stop()) {
        Result<std::vector<ValidationRow>> rows = measured(of, technique, settings, progress);
        if (!rows) return Error{rows.error()};
        if (!progress.stop()) std::move(rows.value().begin(), rows.value().end(), std::back_inserter(out.rows));
      }
      step(1);
    }
  }
  for (const std::string& technique : settings.techniques) {
    if (!glare || progress.stop()) break;
    const Result<std::vector<GlareRow>> rows = validateGlare(technique, settings.brief, settings.render, progress);
    if (!rows) return Error{rows.error()};
    for (const GlareRow& r : rows.value()) {
      const double error = r.got - r.expected;
      out.rows.push_back({kGlareCase,
                          "glare by a ceiling of Lambertian panels in the rooms of CIE 117, H = 2 m, 0.25 H apart",
                          "UGR", "panels summed up one by one, background by radiosity on 12 x 12 patches a surface",
                          fmt::format("{} H x {} H", r.room.x, r.room.y), technique, r.expected, r.got, error, "UGR",
                          std::abs(error) <= kAllowedUgr});
    }
    step(kGlareSteps);
  }
  out.complete = !progress.stop();
  for (const std::string& technique : settings.techniques) out.techniques.push_back(summary(out.rows, technique));
  return out;
}

}  // namespace roomlight
