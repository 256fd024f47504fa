// Rooms beside bright windows: each part of a picture at the exposure that shows it best.
#pragma once

#include "base/image.h"

namespace roomlight {

// Multiplies every pixel by a gain that varies smoothly: four exposures, two stops times `strength` apart, one brighter and two darker, are fused by how near each brings a place to a middle grey
// (Mertens, Kautz & Van Reeth 2007, "Exposure fusion"), on luminance alone, so that colours keep their hue. What is looked at keeps its exposure in the mean.
void exposeLocally(Image& image, float ev100, float strength);

}  // namespace roomlight
