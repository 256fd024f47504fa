// Colours of thermal light.
#pragma once

#include "base/vec.h"

namespace roomlight {

constexpr double kLowestKelvin = 1000, kHighestKelvin = 40000;

// Linear Rec.709 of a black body at `kelvin` (kLowestKelvin..kHighestKelvin), scaled to luminance 1. Planck's law
// against the CIE 1931 observer in the analytic fit of Wyman, Sloan and Shirley 2013, whose error stays below 0.003 in
// x and y. Below about 1900 K blue would be negative: it is cut to 0 and the luminance restored.
Vec3 blackBodyColour(double kelvin);

// CIE 1931 x, y of the same.
Vec2 blackBodyChromaticity(double kelvin);

}  // namespace roomlight
