// Incident light meters, by any shader: illuminance at points of surfaces or of the air.
#pragma once

#include <span>

#include "gather/shading.h"
#include "trace/meter.h"

namespace roomlight {

// A reading for each element, as readMeters() has it.
std::vector<MeterReading> measureIlluminance(const RayScene& rays, const Lights& lights, const SurfaceShader& shader,
                                             std::span<const SurfaceElement> elements, const MeterSettings& settings,
                                             const Progress& progress = {});

// Light on elements kept apart by layers.
struct LayeredReadings {
  size_t layers = 0;
  std::vector<Vec3> lux;               // of element i from layer l: lux[i * layers + l], per channel
  std::vector<float> standardErrorLux; // of their luminance, as `lux`
  Vec3 at(size_t element, size_t layer) const { return lux[element * layers + layer]; }
};

// By a shader that keeps light apart (layers() is not null), in a scene lit by lamps and emissive meshes alone: suns
// and sky are left out. Every element takes fewestSamples and goes on to twice as many, up to mostSamples, until every
// layer is as certain as the tolerance asks, or as it asks of 3 % of the strongest layer there; what comes straight
// from lamps that are points is exact. Does not depend on the number of threads.
LayeredReadings measureInLayers(const RayScene& rays, const Lights& lights, const SurfaceShader& shader,
                                std::span<const SurfaceElement> elements, const MeterSettings& settings,
                                const Progress& progress = {});

}  // namespace roomlight
