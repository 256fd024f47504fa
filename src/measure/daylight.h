// Daylight factors: the share of the light of an overcast sky that comes to a place indoors.
#pragma once

#include "measure/measure.h"
#include "scene/scene.h"

namespace roomlight {

// Illuminance on the open ground under a CIE overcast sky of zenith luminance L_z: 7π/9 L_z (CIE S 011, type 16; Moon &
// Spencer 1942).
double overcastOutdoorLux(double zenithCdM2);

// Puts out lamps, suns and everything that emits, and puts up a CIE overcast sky, L = L_z (1 + 2 sin γ) / 3, that gives
// 10 000 lx on open ground; below the horizon is ground that reflects this.
constexpr double kOvercastLux = 10'000;
void lightByOvercastSky(Scene& scene, double groundReflectance);

// Adds the daylight factor of every grid and point; `lit` is the scene under that sky.
void addDaylight(Measurements& m, const LitScene& lit, const MeterSettings& settings, Stages& stages);

}  // namespace roomlight
