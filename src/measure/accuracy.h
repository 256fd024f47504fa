// How far techniques were off where the light is known: what reports say of the worth of their figures. The same
// figures as in docs/measured/validation.md and docs/measured/meters.md (tests compare them).
#pragma once

#include <array>

namespace roomlight {

struct MeasuredAccuracy {
  const char* technique;
  int places;           // closed forms and CIE 171:2006
  double worstPercent;  // of the size of errors
};

constexpr std::array<MeasuredAccuracy, 3> kMeasuredAccuracy = {
    {{"path", 181, 0.74}, {"hybrid", 181, 1.47}, {"cone", 181, 0.88}}};

// `hybrid` against `path` in a furnished flat: what 95 of 100 meters are within, and the error of their mean, in the
// worse of two lights.
constexpr double kFurnishedWithinPercent = 10.6, kFurnishedMeanPercent = 0.6;

}  // namespace roomlight
