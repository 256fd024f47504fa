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

}  // namespace roomlight
