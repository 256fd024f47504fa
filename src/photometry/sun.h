// Where the sun stands, and how much light it sends through a clear sky.
#pragma once

#include <string_view>

#include "base/result.h"

namespace roomlight {

// A moment in UTC.
struct Moment {
  int year = 2000, month = 1, day = 1;
  double hour = 12;  // of the UTC day; a time zone may have carried it below 0 or above 24
};

// "2026-06-21T14:30+02:00", "2026-06-21T12:30:00Z"; the offset from UTC is required. The error names no place.
Result<Moment> parseMoment(std::string_view text);

struct SunPosition {
  double altitudeRad = 0;  // above the horizon, without refraction
  double bearingRad = 0;   // clockwise from north
};

// The Astronomical Almanac's low-precision formulas as published by Michalsky 1988 ("The Astronomical Almanac's
// algorithm for approximate solar position"): 0.01 degrees from 1950 to 2050. Latitude north and longitude east
// positive.
SunPosition sunPosition(const Moment& moment, double latitudeDeg, double longitudeDeg);

// Illuminance in lux on a surface that faces the sun: 127.5 klx outside the atmosphere, corrected for the earth's
// distance, less `extinction` per air mass (IES RP-21, Gillette et al. 1984; 0.21 under a clear sky). 0 below the
// horizon.
double sunLux(const Moment& moment, double altitudeRad, double extinction = 0.21);

// Square of the earth's mean distance from the sun over that of the day: 0.967 to 1.034.
double sunDistanceFactor(const Moment& moment);

}  // namespace roomlight
