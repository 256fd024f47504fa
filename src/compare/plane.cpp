#include "compare/plane.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"

namespace roomlight {

Kernel gaussianKernel(double sigma, int radius) {
  std::vector<double> weights;
  double sum = 0;
  for (int x = -radius; x <= radius; ++x) {
    weights.push_back(std::exp(-0.5 * x * x / (sigma * sigma)));
    sum += weights.back();
  }
  Kernel kernel;
  for (const double w : weights) kernel.push_back(static_cast<float>(w / sum));
  return kernel;
}

Plane convolve(const Plane& in, const Kernel& alongX, const Kernel& alongY) {
  const int radiusX = static_cast<int>(alongX.size()) / 2, radiusY = static_cast<int>(alongY.size()) / 2;
  const auto width = static_cast<size_t>(in.width), height = static_cast<size_t>(in.height);
  Plane rows(in.width, in.height), out(in.width, in.height);
  parallelRanges(height, 16, [&](size_t begin, size_t end) {
    // The row with its border repeated, so that the inner loop has no conditions.
    std::vector<float> padded(width + alongX.size());
    for (size_t y = begin; y < end; ++y) {
      const float* source = &in.values[y * width];
      for (int x = -radiusX; x < in.width + radiusX; ++x)
        padded[static_cast<size_t>(x + radiusX)] = source[std::clamp(x, 0, in.width - 1)];
      float* target = &rows.values[y * width];
      for (size_t k = 0; k < alongX.size(); ++k) {
        for (size_t x = 0; x < width; ++x) target[x] += alongX[k] * padded[x + k];
      }
    }
  });
  parallelFor(height, 16, [&](size_t y) {
    float* target = &out.values[y * width];
    for (size_t k = 0; k < alongY.size(); ++k) {
      const int row = std::clamp(static_cast<int>(y + k) - radiusY, 0, in.height - 1);
      const float* source = &rows.values[static_cast<size_t>(row) * width];
      for (size_t x = 0; x < width; ++x) target[x] += alongY[k] * source[x];
    }
  });
  return out;
}

Plane channelOf(const Image& image, int channel) {
  Plane plane(image.width, image.height);
  for (size_t i = 0; i < plane.values.size(); ++i) plane.values[i] = image.pixels[i][channel];
  return plane;
}

Plane luminanceOf(const Image& image) {
  Plane plane(image.width, image.height);
  for (size_t i = 0; i < plane.values.size(); ++i) plane.values[i] = luminance(image.pixels[i]);
  return plane;
}

}  // namespace roomlight
