// Colours of light by its temperature: of black bodies, and of what counts as white.
#pragma once

#include <optional>

#include "base/vec.h"

namespace roomlight {

constexpr double kLowestKelvin = 1000, kHighestKelvin = 40000;

// Linear Rec.709 of a black body at `kelvin` (kLowestKelvin..kHighestKelvin), scaled to luminance 1. Planck's law
// against the CIE 1931 observer in the analytic fit of Wyman, Sloan and Shirley 2013, whose error stays below 0.003 in
// x and y. Below about 1900 K blue would be negative: it is cut to 0 and the luminance restored.
Vec3 blackBodyColour(double kelvin);

// CIE 1931 x, y of the same.
Vec2 blackBodyChromaticity(double kelvin);

// CIE 1931 x, y of white light of a temperature: black bodies below 4000 K, CIE daylight above 5000 K, in between a
// mixture. Within kLowestWhiteK..kHighestWhiteK.
constexpr double kLowestWhiteK = 1667, kHighestWhiteK = 25000;
Vec2 whiteChromaticity(double kelvin);

// The temperature whose white is nearest to a linear Rec.709 colour (CIE 1960 u, v). What is green or magenta beyond
// it, and what is warmer or colder than the range, is not white and is left out. The colour is not black.
double nearestWhiteK(Vec3 rgb);

// How far the colour is from the white of a temperature: in CIE 1960 u, v. Beyond 0.05 no one speaks of white (CIE 15
// for correlated colour temperatures).
double distanceFromWhite(Vec3 rgb, double kelvin);

// The temperature of light that counts as white, in whole K; none of coloured light: farther than 0.02 in CIE 1931 x, y
// from the white of the nearest temperature.
std::optional<double> kelvinOf(Vec3 rgb);

// Linear Rec.709 of that white, of luminance 1. Below 1900 K its blue is negative.
Vec3 whiteColour(double kelvin);

}  // namespace roomlight
