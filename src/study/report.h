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
// are; small JPEGs of them are written there too.
Result<std::string> studyHtml(const StudyHeader& header, const StudyResults& results,
                              const std::filesystem::path& folder);

}  // namespace roomlight
