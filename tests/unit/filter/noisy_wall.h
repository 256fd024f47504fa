// Pictures of a wall for tests of filters.
#pragma once

#include "base/sampler.h"
#include "filter/filter.h"

namespace roomlight::test {

// About normal: mean 0, variance 1.
inline float gaussian(Rng& rng) {
  float sum = -6;
  for (int i = 0; i < 12; ++i) sum += rng.uniform();
  return sum;
}

// A wall of albedo 0.5, 1 cm a pixel, that diffuse light of this irradiance / pi falls on, with noise of this standard
// deviation.
inline FilterInput noisyWall(int w, int h, float light, float deviation, uint64_t seed = 0) {
  FilterInput in(w, h);
  for (int y = 0; y < h; ++y) {
    for (int x = 0; x < w; ++x) {
      FilterPixel& p = in.at(x, y);
      Rng rng(static_cast<uint64_t>(y) * 65536 + static_cast<uint64_t>(x), 0, seed);
      p.albedo = Vec3(0.5f);
      p.diffuse = p.albedo * std::max(0.0f, light + deviation * gaussian(rng));
      p.diffuseVariance = deviation * deviation;
      p.normal = {0, 0, 1};
      p.position = {0.01f * static_cast<float>(x), 0.01f * static_cast<float>(y), 0};
      p.roughness = p.surface = 1;
    }
  }
  return in;
}

// Mean and variance of the luminance of part of a picture.
struct Moments {
  double mean = 0, variance = 0;
};
inline Moments momentsOf(const Image& image, int x0, int x1) {
  double sum = 0, squares = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = x0; x < x1; ++x)
      sum += luminance(image.at(x, y)), squares += luminance(image.at(x, y)) * luminance(image.at(x, y));
  }
  const double n = static_cast<double>(image.height) * (x1 - x0), mean = sum / n;
  return {mean, squares / n - mean * mean};
}

}  // namespace roomlight::test
