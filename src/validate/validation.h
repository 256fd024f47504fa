// Runs the cases of cases.h by every technique and judges what meters read.
#pragma once

#include <string>
#include <vector>

#include "base/progress.h"
#include "base/result.h"
#include "engine/settings.h"

namespace roomlight {

struct ValidationRow {
  std::string name, title, unit, basis;  // of the case
  std::string place, technique;
  double expected = 0, got = 0;
  // In per cent of what is expected there or, where that is next to nothing, of a hundredth of the largest value that
  // the case expects; of glare ratings the difference.
  double error = 0;
  std::string errorUnit = "%";  // or "UGR"
  bool pass = false;
};

struct ValidationSummary {
  std::string technique;
  double allowedPercent = 0;  // as MeterAccuracy
  bool ofSum = false;
  double worstPercent = 0;  // of the same, of values that are judged in per cent
  std::string worstPlace;
  int passed = 0, places = 0;
};

struct Validation {
  std::vector<ValidationRow> rows;
  std::vector<ValidationSummary> techniques;
  bool complete = true;  // false: stopped early
  bool pass() const;
};

// Those whose rows say so, the judge first.
std::vector<std::string> validatedTechniques();

struct ValidationSettings {
  std::vector<std::string> techniques = validatedTechniques();
  std::string only;  // cases whose name holds this
  bool brief = false;  // every third place and every fourth room, less certain meters: a quick look
  RenderSettings render;  // technique is overruled
};

constexpr double kAllowedUgr = 0.5;  // that a glare rating may be off

// Errors: an unknown technique, settings out of range.
Result<Validation> validateTechniques(const ValidationSettings& settings, const Progress& progress = {});

// A validation as files.
std::string validationJson(const Validation& validation);
// One page that needs nothing else: a summary, a dot for every value by technique, and the table of all. `plots`: as of
// report::page().
std::string validationHtml(const Validation& validation, const std::string& version, const std::string& plots = {});

}  // namespace roomlight
