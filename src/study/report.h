// A study as files.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "study/study.h"

namespace roomlight {

// Where and how it was run, and what each technique is, by its name: rows of name and value.
struct StudyHeader {
  std::vector<std::pair<std::string, std::string>> about{}, techniques{};
};

// What roomlight asks of its own techniques after the figures of the published study, and what came out; none where the
// plan does not ask for that.
struct StudyVerdict {
  std::string asked, measured;
  bool met = false;
};
std::vector<StudyVerdict> studyVerdicts(const StudyResults& results);

std::string studyJson(const StudyHeader& header, const StudyResults& results);
// One line a point of a curve, an external picture or a walk; median seconds.
std::string studyCsv(const StudyResults& results);
// Tables alone, for documents.
std::string studyMarkdown(const StudyHeader& header, const StudyResults& results);
// One page that needs nothing else, with curves, bars, pictures and error maps. `folder`: where the study's pictures
// are; small JPEGs of them are written there too. `plots`: as of report::page().
Result<std::string> studyHtml(const StudyHeader& header, const StudyResults& results,
                              const std::filesystem::path& folder, const std::string& plots = {});

// Colour of the i-th technique, the same in every plot: "#rrggbb". The judge's is grey.
std::string colourOf(const std::vector<StudyCurve>& curves, size_t i);

// A plot a case of error beyond noise over seconds, and a table of every point.
std::string curvesPlot(const std::vector<StudyCase>& cases);

struct Bar {
  std::string name, colour;
  double value = 0, published = 0;  // published: 0: none
};
// Lying bars, the longest over the whole width, each with its number; a tick where the published value stands in ratio
// to that of the bar `cone`, none without that bar.
std::string barsHtml(const std::vector<Bar>& bars, const std::string& unit);

}  // namespace roomlight
