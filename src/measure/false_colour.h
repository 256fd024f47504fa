// Colours for amounts of light: a scale that looks even, and round numbers to mark it with.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "base/image.h"
#include "base/vec.h"

namespace roomlight {

// t from 0 (dark violet) to 1 (light yellow), encoded sRGB 0..1. Even steps of t are even steps of lightness in Oklab
// (Ottosson 2020), hue turns steadily from blue over green to yellow, and chroma is as high as the display allows up to
// a limit: readable in grey and for colour-blind people.
Vec3 falseColour(double t);
std::string hexColour(Vec3 encoded);  // "#20a0ff"

// The amounts between which the scale runs, logarithmic as the eye is.
struct LightScale {
  double low = 1, high = 1000;
  double position(double value) const;  // 0..1
};
// From the values (not numbers left out): their 5th and 99th percentiles rounded outwards to steps of roundSteps(), a
// factor 3 to 150 apart.
LightScale scaleOf(std::span<const float> values);

// The steps by which EN 12464-1 grades illuminances, 1 - 1.5 - 2 - 3 - 5 - 7.5 - 10 and so on, from low to high.
std::vector<double> roundSteps(double low, double high);

// Pictures that show how bright things are instead of how they look. Luminance in all three channels, cd/m².
Image luminanceOnly(const Image& image);
// Scale for false colours, by scaleOf().
LightScale luminanceScale(const Image& image);
// Encoded for display: grey in proportion to luminance, white from `whiteCdM2` on.
Image greyPicture(const Image& image, double whiteCdM2);
// Encoded for display: colours of the scale, and to the right of the picture what they mean.
Image falseColourPicture(const Image& image, const LightScale& scale);

}  // namespace roomlight
