// Which pixels need more camera rays: those whose noise is not shared with like neighbours, and those on edges of things.
#pragma once

#include <vector>

#include "gather/pixel_shader.h"

namespace roomlight {

// One flag a pixel. `tolerance`: relative standard error of luminance that the filter can be trusted with.
std::vector<uint8_t> noisyPixels(const FilterInput& sums, const std::vector<PixelCount>& counts, float tolerance);

}  // namespace roomlight
