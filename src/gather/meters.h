// Incident light meters, by any shader: illuminance at points of surfaces or of the air.
#pragma once

#include <span>

#include "gather/shading.h"
#include "trace/meter.h"

namespace roomlight {

// A reading for each element, as readMeters() has it.
std::vector<MeterReading> measureIlluminance(const RayScene& rays, const Lights& lights, const SurfaceShader& shader, std::span<const SurfaceElement> elements,
                                             const MeterSettings& settings, const Progress& progress = {});

}  // namespace roomlight
