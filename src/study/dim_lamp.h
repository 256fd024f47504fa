// Light for scenes that bring none: one weak bare lamp before the camera.
#pragma once

#include "scene/scene.h"
#include "study/run_store.h"
#include "study/study_plan.h"

namespace roomlight {

// Where it hangs: half way from the camera to what is met straight ahead, two metres from the camera at most.
Vec3 dimLampPosition(const Scene& scene, const Camera& camera);

// Gives every light of the plan, also those of walks, that asks for such a lamp a lighting file in the store, which
// switches all other light off. Opens the scenes whose file is not there yet.
Status writeDimLamps(StudyPlan& plan, const RunStore& store);

}  // namespace roomlight
