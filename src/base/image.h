// Pictures in memory; rows from the top.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/vec.h"

namespace roomlight {

struct ImageSize {
  int width = 0, height = 0;  // pixels
  bool operator==(const ImageSize&) const = default;
};

// Linear RGB, luminance(rgb) in cd/m² unless the owner says otherwise.
struct Image {
  int width = 0, height = 0;
  std::vector<Vec3> pixels;  // width * height, row-major

  Image() = default;
  Image(int w, int h) : width(w), height(h), pixels(static_cast<size_t>(w) * static_cast<size_t>(h)) {}
  ImageSize size() const { return {width, height}; }
  Vec3& at(int x, int y) {
    return pixels[static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x)];
  }
  const Vec3& at(int x, int y) const {
    return pixels[static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x)];
  }
};

// A picture of one number a pixel.
struct Plane {
  int width = 0, height = 0;
  std::vector<float> values;  // row-major, rows from the top

  Plane() = default;
  Plane(int w, int h) : width(w), height(h), values(static_cast<size_t>(w) * static_cast<size_t>(h)) {}
  float& at(int x, int y) {
    return values[static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x)];
  }
  float at(int x, int y) const {
    return values[static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x)];
  }
};

// A picture as files and screens have it: sRGB in bytes, rows from the top, three channels or four with alpha that is
// not multiplied in.
struct ByteImage {
  int width = 0, height = 0, channels = 3;
  std::vector<uint8_t> samples;  // channels of a pixel side by side

  ByteImage() = default;
  ByteImage(int w, int h, int c)
      : width(w),
        height(h),
        channels(c),
        samples(static_cast<size_t>(w) * static_cast<size_t>(h) * static_cast<size_t>(c)) {}
  size_t pixelCount() const { return static_cast<size_t>(width) * static_cast<size_t>(height); }
  const uint8_t* row(int y) const {
    return samples.data() + static_cast<size_t>(y) * static_cast<size_t>(width) * static_cast<size_t>(channels);
  }
};

}  // namespace roomlight
