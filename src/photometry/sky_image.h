// Skies given by a formula, as pictures that every later stage reads.
#pragma once

#include <functional>

#include "base/image.h"

namespace roomlight {

// Of a unit direction with y > 0; y is up. Not negative, of any unit.
using SkyFunction = std::function<double(Vec3)>;

// What the sky's half sphere gives to a level surface, in the function's unit times steradian. Midpoint rule of 256 x 512 cells even in
// sin² of the altitude and in bearing; error below 1e-4 for CIE and Perez skies.
double horizontalIlluminance(const SkyFunction& luminance);

// Equirectangular picture of 512 x 256 pixels in cd/m², laid out as Sky::image with its edge at the horizon: above it the sky, scaled so
// that a level surface has `horizontalLux` from it (0: black) and coloured by `colour` of luminance 1; below it ground of even luminance.
// A function that is black all over gives a black sky.
Image skyImage(const SkyFunction& luminance, double horizontalLux, Vec3 colour, Vec3 groundCdM2);

}  // namespace roomlight
