// A picture of one number a pixel, and separable convolution on it: what SSIM and FLIP are made of.
#pragma once

#include <vector>

#include "base/image.h"

namespace roomlight {

struct Plane {
  int width = 0, height = 0;
  std::vector<float> values;  // row-major, rows from the top

  Plane() = default;
  Plane(int w, int h) : width(w), height(h), values(static_cast<size_t>(w) * static_cast<size_t>(h)) {}
};

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
