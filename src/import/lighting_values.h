// Values that lamps, suns and skies of a lighting file share. What is wrong is told to the place; see
 // json/json_reader.h.
#pragma once

#include <initializer_list>
#include <string>

#include "json/json_reader.h"

namespace roomlight {

constexpr double kMostLight = 1e12;  // of any unit; keeps squares finite in floats
constexpr double kFarthestM = 1e6;

inline double rad(double degrees) { return degrees * static_cast<double>(kPi) / 180; }

Vec3 readDirection(const JsonPlace& j);  // [x, y, z] of any length but zero, made unit

// Colour of luminance 1 by the keys of `j`: white, a colour temperature, or the given linear Rec.709 scaled.
Vec3 readColour(const JsonPlace& j);

// The one of the keys that is there; fails where none is or more than one, and returns nothing then.
std::string theOne(const JsonPlace& j, std::initializer_list<const char*> keys);

// Fails where one of the keys is there: "means nothing <why>".
void forbid(const JsonPlace& j, std::initializer_list<const char*> keys, const std::string& why);

}  // namespace roomlight
