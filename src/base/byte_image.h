// A picture as files and screens have it: sRGB in bytes, rows from the top, three channels or four with alpha that is
 // not multiplied in.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace roomlight {

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
