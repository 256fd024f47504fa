// Tables of the plan file by kind.
#pragma once

#include <vector>

#include "batch/plan_axes.h"

namespace roomlight::batch {

struct SectionKind {
  const char* name;  // "pictures", ...
  void (*read)(const optimise::TomlPlace&, const PlanPaths&, Section&);
};
const std::vector<SectionKind>& sectionKinds();

// Long commands that are cut: their tasks are parts of one result, which merge puts together.
void readOptimise(const optimise::TomlPlace& table, const PlanPaths& paths, Section& out);
void readStudy(const optimise::TomlPlace& table, const PlanPaths& paths, Section& out);

}  // namespace roomlight::batch
