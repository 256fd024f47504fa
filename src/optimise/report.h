// What a run found, for people and programs.
#pragma once

#include "optimise/evaluate.h"
#include "optimise/proposal.h"
#include "search/methods.h"

namespace roomlight::optimise {

struct Proposed {
  size_t index = 0;  // of the front
  std::string name;  // "design 1"; its lighting files begin so
  std::vector<BillLine> bill;
  DesignResult result;
  std::optional<Certificate> certificate;
  std::vector<std::string> lightingFiles;  // per condition
};

struct TracePoint {
  size_t evaluations = 0;
  double seconds = 0, hypervolume = 0;
};
struct MethodResult {
  std::string name;
  size_t evaluations = 0, polished = 0;
  double seconds = 0, hypervolume = 0;  // share of the box
  std::vector<TracePoint> trace;        // of this run; empty for what was known before
};

struct Report {
  const StudyFile& study;
  const Candidates& candidates;
  const Meters& meters;
  const Model& model;
  search::Archive front;
  std::vector<Proposed> designs;
  std::vector<MethodResult> methods;  // this run first, then baselines
  std::vector<std::pair<std::string, std::string>> facts;
  double responseSeconds = 0, baseSeconds = 0;  // 0: known from before
  double designsASecond = 0;                    // evaluated
  double lookUpsASecond = 0;  // of a design's neighbours on the front, as a surrogate would (evaluate.h)
};

// One page on its own; `home` is drawn. `plots`: as of report::page().
Result<std::string> reportHtml(const Report& report, const Scene& home, const std::string& plots = {});
// Every design of the front: objectives, watts, each place's luminaire and dimming.
std::string frontCsv(const Report& report);
// Every point of every design that was solved in full: predicted and full lux, and how certain that is.
std::string pointsCsv(const Report& report);
// How it went, for scripts: times, methods with their traces, certificates, and the exact least watts where that can be
// asked.
std::string runJson(const Report& report);

}  // namespace roomlight::optimise
