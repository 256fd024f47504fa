// A picture of the light on a surface: colours, contours, the plan around it, lamps and a length to compare with.
 // Inline SVG.
#pragma once

#include <string>

#include "measure/false_colour.h"
#include "measure/measurements.h"

namespace roomlight {

// `number` tells the pictures of one page apart. Some ten to hundred kilobytes.
std::string lightMapSvg(const GridReading& grid, const Scene& scene, const LightScale& scale, int number);
// How a page shows them.
extern const char* const kLightMapStyle;
// Colours and what they mean.
std::string legendSvg(const LightScale& scale, const std::string& unit);

}  // namespace roomlight
