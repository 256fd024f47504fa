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

}  // namespace roomlight::batch
