// Which pixels need more camera rays: those whose noise is not shared with like neighbours, and those on edges of
 // things.
#pragma once

#include <vector>

#include "gather/pixel_shader.h"

namespace roomlight {

// Whether two pixels see one surface: by normals and places, the first pixel's being that of its tangent plane.
bool onOneSurface(Vec3 normal, Vec3 position, Vec3 otherNormal, Vec3 otherPosition);

// What pixel i would be by the light of those beside it that see the same surface; where there is none, what it is.
FilterPixel meanBeside(const FilterInput& sums, const std::vector<PixelCount>& counts, size_t i);

// Of each pixel, how many more rays it needs beside those it had; 0: none. `tolerance`: relative standard error of
// luminance that may be left. `left`: of each pixel after the filter; empty: there is none.
std::vector<uint16_t> raysNeeded(const FilterInput& sums, const std::vector<PixelCount>& counts,
                                 const FilteredLuminance& left, float tolerance);

}  // namespace roomlight
