// How bright a picture is shown.
#pragma once

#include <vector>

#include "base/image.h"

namespace roomlight {

// A room lit by 300 lx, as a light meter shows it: one exposure for all rooms and hours.
constexpr float kHomeEv100 = 6.9f;

// EV100 that puts what is looked at to a middle grey: the geometric mean of the luminance, more of the middle than of
// the edges, without windows, lamps and holes that are several stops away from most of it. Black pixels are void: a
// picture that is mostly void is shown a little brighter; a black one gives 0.
float lookedAtEv100(const Image& luminanceImage);

// The pixels where `mask` is so, in a row.
Image pixelsWhere(const Image& image, const std::vector<bool>& mask, bool so);

// Plans are exposed for rooms, and their grounds may lie in the sun: dims what is not in `rooms` (one entry a pixel),
// as a whole, until it is metered at most two thirds of a stop above ev100.
void holdGrounds(Image& image, const std::vector<bool>& rooms, float ev100);

// Rooms beside bright windows: each part of a picture at the exposure that shows it best. Gains, one a pixel, that vary
// smoothly: four exposures, one brighter by two stops times `strength` and two darker by 2.6 each, are fused by how
// near each brings a place to a middle grey (Mertens, Kautz & Van Reeth 2007, "Exposure fusion"), on luminance alone,
// so that colours keep their hue. What is looked at, as `lookedAtEv100` meters it, keeps its exposure.
Plane localExposure(const Image& image, float ev100, float strength);

// The same for frames, faster: computed at a quarter of the width and height and upsampled along edges.
Plane quickLocalExposure(const Image& image, float ev100, float strength);

}  // namespace roomlight
