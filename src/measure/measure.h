// Meters held into a lit scene.
#pragma once

#include "engine/lit_scene.h"
#include "measure/measurements.h"

namespace roomlight {

struct MeasureSettings {
  MeterSettings meters;
  bool maps = false;  // readings up to the walls and closer together too, for pictures of the light
};

// All of the plan; where it has no rooms, those of the scene; where nothing at all is known, the areas indoors that
// findAreas() finds. Once cancelled (`stages`), readings are those so far.
Measurements measure(const LitScene& lit, const MeterPlan& plan, const MeasureSettings& settings, Stages& stages);

}  // namespace roomlight
