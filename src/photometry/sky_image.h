// Skies given by a formula, as pictures that every later stage reads.
#pragma once

#include <functional>

#include "base/image.h"

namespace roomlight {

// Of a unit direction with y > 0; y is up. Not negative, of any unit.
using SkyFunction = std::function<double(Vec3)>;

// What the sky's half sphere gives to a level surface, in the function's unit times steradian. Midpoint rule of 256 x
// 512 cells even in sin² of the altitude and in bearing; error below 1e-4 for CIE and Perez skies.
double horizontalIlluminance(const SkyFunction& luminance);

// How a sky is coloured, all of it without a change of luminance.
struct SkyColour {
  Vec3 mean{1, 1, 1};        // of luminance 1
  double miredPerDecade = 0; // how much warmer it is where it is ten times as bright as in the mean
  SkyColour() = default;
  SkyColour(Vec3 colour) : mean(colour) {}
};
// Of clear skies: Chain, Dumortier & Fontoynont 1999, 10^6 K / T = -132.1 + 59.77 log10(L in cd/m²).
constexpr double kClearSkyMiredPerDecade = 59.77;

// Where the sun stands that makes a sky: one below the horizon makes it as one on the horizon.
Vec3 sunInSky(Vec3 toSun);

// Equirectangular picture of 512 x 256 pixels in cd/m², laid out as Sky::image with its edge at the horizon: above it
// the sky, scaled so that a level surface has `horizontalLux` from it (0: black); black below it. A function that is
// black all over gives a black sky.
Image skyImage(const SkyFunction& luminance, double horizontalLux, const SkyColour& colour);

// What a level surface has of the upper half of such a picture, in lux.
Vec3 horizontalLux(const Image& sky);

// Paints the lower half: even matt ground that the sky above and `sunLux` (on a level surface) light, as bright as a
// level surface of that reflectance in the open. Towards the horizon it fades into the haze of the sky over it, to 1/e
// at hazeRad (0: no haze).
constexpr float kHazeRad = 0.015f;
void paintGround(Image& sky, Vec3 reflectance, Vec3 sunLux, float hazeRad);

}  // namespace roomlight
