// A reflected-light meter with a narrow field: the mean luminance in a square of the view.
#pragma once

#include <span>

#include "engine/lit_scene.h"
#include "measure/measurements.h"

namespace roomlight {

// A camera that looks from `position` along the unit `direction`, upright unless it looks straight up or down.
Camera cameraAt(Vec3 position, Vec3 direction, float yFovRad);

std::vector<SpotReading> readSpots(const LitScene& lit, std::span<const SpotPlan> plans, const Progress& progress);

}  // namespace roomlight
