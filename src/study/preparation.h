// What is done before hours are spent on a study: its walk files are read, and scenes without light get a lamp.
#pragma once

#include "scene/scene.h"
#include "study/run_store.h"
#include "study/study_plan.h"

namespace roomlight {

// Reads every walk of the plan on its scene in its light, dim lamps included, as `roomlight walk` does.
// Scenes and lights that cannot be opened are left to the measuring, which tells of them in a remark. A walk that was
// good is not read again by the same `program` (of StudySettings). Errors: those of walk files.
Status checkWalks(const StudyPlan& plan, const RunStore& store, const std::string& program);

// Light for scenes that bring none: one weak bare lamp before the camera. Where it hangs: half way from the camera to
// what is met straight ahead, two metres from the camera at most.
Vec3 dimLampPosition(const Scene& scene, const Camera& camera);

// Gives every light of the plan, also those of walks, that asks for such a lamp a lighting file in the store, which
// switches all other light off. Opens the scenes whose file is not there yet.
Status writeDimLamps(StudyPlan& plan, const RunStore& store);

}  // namespace roomlight
