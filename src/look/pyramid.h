// Pictures of one channel, halved again and again (Burt & Adelson 1983).
#pragma once

#include <cstddef>
#include <vector>

namespace roomlight {

struct Plane {
  int width = 0, height = 0;
  std::vector<float> values;
  Plane() = default;
  Plane(int w, int h) : width(w), height(h), values(static_cast<size_t>(w) * static_cast<size_t>(h)) {}
  float& at(int x, int y) { return values[static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x)]; }
  float at(int x, int y) const { return values[static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x)]; }
};

// Blurred and halved; sides of odd length are rounded up.
Plane halved(const Plane& plane);
// Smoothly enlarged to a size that halved() made this from.
Plane doubled(const Plane& plane, int width, int height);

// The plane and its halves, down to a shorter side of at most `least`.
std::vector<Plane> gaussianPyramid(Plane plane, int least);

}  // namespace roomlight
