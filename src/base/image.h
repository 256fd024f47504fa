// A linear RGB picture: rows from the top, luminance(rgb) in cd/m² unless the owner says otherwise.
#pragma once

#include <cstddef>
#include <vector>

#include "base/vec.h"

namespace roomlight {

struct Image {
  int width = 0, height = 0;
  std::vector<Vec3> pixels;  // width * height, row-major

  Image() = default;
  Image(int w, int h) : width(w), height(h), pixels(static_cast<size_t>(w) * static_cast<size_t>(h)) {}
  Vec3& at(int x, int y) {
    return pixels[static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x)];
  }
  const Vec3& at(int x, int y) const {
    return pixels[static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x)];
  }
};

}  // namespace roomlight
