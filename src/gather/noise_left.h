// How far a filtered picture is off by noise, as the filter tells it.
#pragma once

#include <cstdint>
#include <span>

#include "filter/filter.h"

namespace roomlight {

// Root mean square over pixels, relative to their luminance (dark ones: to a twentieth of the mean). `left`: what was left when pixels had had `raysThen` rays; they have had `raysNow` by now.
// Below 0 where that is empty. Light that caches have wrong, or that the filter has spread, is not seen.
double noiseLeft(const FilteredLuminance& left, std::span<const uint32_t> raysThen, std::span<const uint32_t> raysNow);

}  // namespace roomlight
