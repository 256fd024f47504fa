// Separable convolution of pictures of one number a pixel: what SSIM, FLIP and blotches are made of.
#pragma once

#include <vector>

#include "base/image.h"

namespace roomlight {

// A kernel of odd length, its middle on the pixel.
using Kernel = std::vector<float>;

// exp(-x²/(2 sigma²)) at x = -radius .. radius, divided by its sum.
Kernel gaussianKernel(double sigma, int radius);

// Convolves rows with `alongX` and columns with `alongY`; pixels outside repeat the border. In parallel over rows.
Plane convolve(const Plane& in, const Kernel& alongX, const Kernel& alongY);

// One channel of a picture, or its luminance.
Plane channelOf(const Image& image, int channel);
Plane luminanceOf(const Image& image);

}  // namespace roomlight
