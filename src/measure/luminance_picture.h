// Pictures that show how bright things are instead of how they look.
#pragma once

#include "base/image.h"
#include "measure/false_colour.h"

namespace roomlight {

// Luminance in all three channels, cd/m².
Image luminanceOnly(const Image& image);
// Scale for false colours, by scaleOf().
LightScale luminanceScale(const Image& image);
// Encoded for display: grey in proportion to luminance, white from `whiteCdM2` on.
Image greyPicture(const Image& image, double whiteCdM2);
// Encoded for display: colours of the scale, and to the right of the picture what they mean.
Image falseColourPicture(const Image& image, const LightScale& scale);

}  // namespace roomlight
