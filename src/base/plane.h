// A picture of one number a pixel.
#pragma once

#include <cstddef>
#include <vector>

namespace roomlight {

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

}  // namespace roomlight
