// Which pixels need more camera rays: those whose noise is not shared with like neighbours, and those on edges of things.
#pragma once

#include <vector>

#include "gather/pixel_shader.h"

namespace roomlight {

// Whether two pixels see one surface: by normals and places, the first pixel's being that of its tangent plane.
bool onOneSurface(Vec3 normal, Vec3 position, Vec3 otherNormal, Vec3 otherPosition);

// One flag a pixel. `tolerance`: relative standard error of luminance that the filter can be trusted with.
std::vector<uint8_t> noisyPixels(const FilterInput& sums, const std::vector<PixelCount>& counts, float tolerance);

}  // namespace roomlight
