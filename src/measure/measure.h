// Meters held into a lit scene: illuminance, luminance, daylight factors.
#pragma once

#include <span>

#include "engine/lit_scene.h"
#include "measure/measurements.h"
#include "scene/scene.h"

namespace roomlight {

struct MeasureSettings {
  MeterSettings meters;
  bool maps = false;  // readings up to the walls and closer together too, for pictures of the light
};

// All of the plan; where it has no rooms, those of the scene; where nothing at all is known, the areas indoors that
// findAreas() finds. Once cancelled (`stages`), readings are those so far.
Measurements measure(const LitScene& lit, const MeterPlan& plan, const MeasureSettings& settings, Stages& stages);

// A camera that looks from
// `position` along the unit `direction`, upright unless it looks straight up or down.
Camera cameraAt(Vec3 position, Vec3 direction, float yFovRad);

// By a reflected-light meter with a narrow field: the mean luminance in a square of the view.
std::vector<SpotReading> readSpots(const LitScene& lit, std::span<const SpotPlan> plans, const Progress& progress);

// Daylight factors: the share of the light of an overcast sky that comes to a place indoors. Illuminance on the open
// ground under a CIE overcast sky of zenith luminance L_z: 7π/9 L_z (CIE S 011, type 16; Moon & Spencer 1942).
double overcastOutdoorLux(double zenithCdM2);

// Puts out lamps, suns and everything that emits, and puts up a CIE overcast sky, L = L_z (1 + 2 sin γ) / 3, that gives
// 10 000 lx on open ground; below the horizon is ground that reflects this.
constexpr double kOvercastLux = 10'000;
void lightByOvercastSky(Scene& scene, double groundReflectance);

// Adds the daylight factor of every grid and point; `lit` is the scene under that sky.
void addDaylight(Measurements& m, const LitScene& lit, const MeterSettings& settings, Stages& stages);

// Lights the scene by that sky and adds them. Lamps and materials are as before afterwards; suns and sky are not.
Status measureDaylight(Scene& scene, double groundReflectance, const RenderSettings& render,
                       const MeterSettings& settings, Measurements& m, Stages& stages);

}  // namespace roomlight
