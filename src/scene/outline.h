// Outlines of floors: polygons of corners (x, z).
#pragma once

#include <span>
#include <vector>

#include "base/vec.h"

namespace roomlight {

// Above zero where the corners run counter-clockwise seen from above.
double signedAreaM2(std::span<const Vec2> corners);
// Whether two sides meet other than where they follow one another.
bool crossesItself(std::span<const Vec2> corners);
bool contains(std::span<const Vec2> corners, Vec2 p);
double distanceToEdgeM(std::span<const Vec2> corners, Vec2 p);
// Unit direction of the longest side.
Vec2 longestSide(std::span<const Vec2> corners);

}  // namespace roomlight
