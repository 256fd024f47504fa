// What all parts of a lighting file share: limits, directions and colours.
#pragma once

#include <initializer_list>
#include <string>

#include "import/json_reader.h"

namespace roomlight::importers {

constexpr double kMostLight = 1e12;  // of any unit; keeps squares finite in floats
constexpr double kFarthestM = 1e6;

inline double rad(double degrees) { return degrees * kPi / 180; }

Vec3 direction(const JsonPlace& j);  // unit

// Colour of luminance 1: white, a colour temperature, or the given linear Rec.709 scaled.
Vec3 colour(const JsonPlace& j);

// Exactly one of the keys must be there: which, or nothing after an error.
std::string theOne(const JsonPlace& j, std::initializer_list<const char*> keys);

}  // namespace roomlight::importers
