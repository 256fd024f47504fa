// White balance: the colours an eye adapted to one white would need under D65 to look the same.
#pragma once

#include "base/vec.h"

namespace roomlight {

// CIE 1931 x, y of white light of a temperature: black bodies below 4000 K, CIE daylight above 5000 K, in between a mixture.
// Within kLowestWhiteK..kHighestWhiteK.
constexpr double kLowestWhiteK = 1667, kHighestWhiteK = 25000;
Vec2 whiteChromaticity(double kelvin);

// The temperature whose white is nearest to a linear Rec.709 colour (CIE 1960 u, v). What is green or magenta beyond it, and
// what is warmer or colder than the range, is not white and is left out. The colour is not black.
double nearestWhiteK(Vec3 rgb);

// How far an eye adapts to the white of a room whose mean luminance is that: 0 not at all, 1 in full. CIECAM02 and CIECAM16,
// average surround: 0.82 in the dark, 0.86 at 20 cd/m², 1 from 500 cd/m² on.
double degreeOfAdaptation(double luminanceCdM2);

// Linear Rec.709 seen under the white to linear Rec.709 under D65: von Kries scaling of CAT16 responses (Li et al. 2017).
Affine whiteBalance(double whiteK, double degree);

}  // namespace roomlight
