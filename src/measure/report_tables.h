// Readings as tables, for a page or for a terminal. Without rows where there is nothing to say.
#pragma once

#include <vector>

#include "measure/measurements.h"
#include "report/table.h"

namespace roomlight {

enum class Medium { Page, Terminal };

report::Table gridTable(const Measurements& m, Medium medium);
report::Table pointTable(const Measurements& m, Medium medium);
report::Table spotTable(const Measurements& m, Medium medium);
report::Table glareTable(const Measurements& m, Medium medium);
report::Table powerTable(const Measurements& m, Medium medium);
report::Table targetTable(const std::vector<Verdict>& verdicts, Medium medium);

}  // namespace roomlight
