// Sections of the HTML report.
#pragma once

#include <initializer_list>
#include <string>

#include "measure/measurements.h"
#include "measure/report.h"

namespace roomlight::report {

// A cell of a table, `kind`: its class; `text` is HTML. A row of heads, to the left those with "<" before them and
// those from `leftFrom` on.
std::string cell(const std::string& text, const char* kind = "");
std::string head(std::initializer_list<const char*> names, size_t leftFrom = 99);
std::string verdictCell(bool met);
std::string fileName(const std::string& path);

std::string titleBlock(const ReportHeader& h);
std::string picture(const ReportHeader& h);
std::string plans(const Measurements& m, const Scene& scene, const Schedule& schedule);
std::string roomTargetTable(const Measurements& m);
std::string luminaireSchedule(const Schedule& schedule);
// What the figures are worth: technique, certainty, measured error, what is not modelled.
std::string worth(const ReportHeader& h, const Measurements& m);

}  // namespace roomlight::report
