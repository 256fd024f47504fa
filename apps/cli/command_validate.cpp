// roomlight validate: meters of every technique where the light is known.
#include <fmt/format.h>

#include <memory>

#include "base/parallel.h"
#include "base/write_file.h"
#include "arguments.h"
#include "commands.h"
#include "console.h"
#include "engine/render.h"
#include "engine/settings.h"
#include "exit_status.h"
#include "output_files.h"
#include "started_programs.h"
#include "validate/validation.h"

namespace roomlight::cli {
namespace {

struct ValidateOptions {
  std::vector<std::string> techniques;
  std::string only, json, html;
  int threads = 0;
  uint64_t seed = 0;
  bool brief = false, quiet = false;
};

// One line a case and technique: its worst place.
void printValidation(const Validation& v) {
  fmt::print("{:<24} {:<7} {:<38} {:>10} {:>10} {:>9}\n", "case", "by", "worst place", "expected", "got", "error");
  for (size_t i = 0; i < v.rows.size();) {
    size_t worst = i, end = i;
    for (; end < v.rows.size() && v.rows[end].technique == v.rows[i].technique && v.rows[end].name == v.rows[i].name;
         ++end) {
      if (std::abs(v.rows[end].error) > std::abs(v.rows[worst].error)) worst = end;
    }
    const ValidationRow& r = v.rows[worst];
    fmt::print("{:<24} {:<7} {:<38} {:>10.5g} {:>10.5g} {:>+7.2f} {}{}\n", r.name, r.technique, r.place, r.expected,
               r.got, r.error, r.errorUnit, r.pass ? "" : "  MISSED");
    i = end;
  }
  for (const ValidationSummary& s : v.techniques) {
    fmt::print("{}: {} of {} places met ({:g} %{}; glare ratings {:g})", s.technique, s.passed, s.places,
               s.allowedPercent, s.ofSum ? " of the sum over a case" : "", kAllowedUgr);
    fmt::print("{}\n",
               s.worstPlace.empty() ? "" : fmt::format("; largest error {:+.2f} %, {}", s.worstPercent, s.worstPlace));
  }
}

int runValidate(const ValidateOptions& o) {
  interrupted();
  for (const std::string& file : {o.json, o.html}) {
    if (file.empty()) continue;
    if (const Status s = checkWritable(file); !s) return failed(s.error());
  }
  if (const Status s = checkDistinct({o.json, o.html}); !s) return failed(s.error());
  for (const std::string& technique : o.techniques) {
    if (const Status s = checkTechnique(technique); !s) return failed(s.error());
  }
  ValidationSettings settings;
  if (!o.techniques.empty()) settings.techniques = o.techniques;
  settings.only = o.only;
  settings.brief = o.brief;
  settings.render.seed = o.seed;
  settings.render.threads = o.threads;
  ProgressDisplay display(o.quiet);
  display.report("validate", 0);
  Progress progress{[&](float f) { display.report("validate", f); }, &interrupted()};
  Result<Validation> v = Error{""};
  withThreads(o.threads, [&] { v = validateTechniques(settings, progress); });
  if (!v) return failed(v.error());
  if (v.value().complete && v.value().rows.empty())
    return failed(fmt::format("--case: no case's name holds '{}'", o.only));
  if (!o.quiet) printValidation(v.value());
  if (!o.json.empty()) {
    if (const Status s = writeWhole(o.json, validationJson(v.value())); !s) return failed(s.error(), kFailed);
  }
  if (!o.html.empty()) {
    if (const Status s = writeWhole(o.html, validationHtml(v.value(), version(), reportPlots())); !s)
      return failed(s.error(), kFailed);
  }
  if (!v.value().complete) return failed("interrupted; what was measured so far is above", kInterrupted);
  return v.value().pass() ? kOk : kFailed;
}

}  // namespace

Registered addValidate(CLI::App& program) {
  const auto o = std::make_shared<ValidateOptions>();
  CLI::App* app = program.add_subcommand(
      "validate", "Measure scenes whose light is known, by every technique, and judge the result");
  app->add_option("--technique", o->techniques, "Only this technique; may be repeated")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  app->add_option("--case", o->only, "Only cases whose name holds this, such as 5.11");
  app->add_flag("--brief", o->brief, "Every third place, with more noise");
  app->add_option("--json", o->json, "Write all values to this file");
  app->add_option("--html", o->html, "Write a page with all values to this file");
  app->add_option("--seed", o->seed, "Random seed");
  app->add_option("--threads", o->threads, "Threads; 0: all cores")->check(CLI::Range(0, 1024));
  app->add_flag("--quiet", o->quiet, "Only errors; the exit status tells: 0 all met, 1 some missed");
  app->footer(
      "Cases: closed forms, furnaces, CIE 171:2006 (docs/methods/validation.md).\nExample:\n  roomlight validate "
      "--html validation.html");
  return {app, [o] { return runValidate(*o); }};
}

}  // namespace roomlight::cli
