// Walk files of a study, read before hours are spent.
#pragma once

#include "study/run_store.h"
#include "study/study_plan.h"

namespace roomlight {

// Reads every walk of the plan on its scene in its light, lamps of dim_lamp.h included, as `roomlight walk` does.
// Scenes and lights that cannot be opened are left to the measuring, which tells of them in a remark. A walk that was
// good is not read again by the same `program` (of StudySettings). Errors: those of walk files.
Status checkWalks(const StudyPlan& plan, const RunStore& store, const std::string& program);

}  // namespace roomlight
