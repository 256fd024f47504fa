// Rooms beside bright windows: each part of a picture at the exposure that shows it best.
#pragma once

#include "base/image.h"
#include "base/plane.h"

namespace roomlight {

// Gains, one a pixel, that vary smoothly: four exposures, one brighter by two stops times `strength` and two darker
// by 2.6 each, are fused by how near each brings a place to a middle grey (Mertens, Kautz & Van Reeth 2007, "Exposure
// fusion"), on luminance alone, so that colours keep their hue. What is looked at, as `lookedAtEv100` meters it, keeps
// its exposure.
Plane localExposure(const Image& image, float ev100, float strength);

// The same for frames, faster: computed at a quarter of the width and height and upsampled along edges.
Plane quickLocalExposure(const Image& image, float ev100, float strength);

}  // namespace roomlight
