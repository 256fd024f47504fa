// Pictures of one channel, halved again and again (Burt & Adelson 1983).
#pragma once

#include <vector>

#include "base/image.h"

namespace roomlight {

// Blurred and halved; sides of odd length are rounded up.
Plane halved(const Plane& plane);
// Smoothly enlarged to a size that halved() made this from.
Plane doubled(const Plane& plane, int width, int height);

// The plane and its halves, down to a shorter side of at most `least`.
std::vector<Plane> gaussianPyramid(Plane plane, int least);

}  // namespace roomlight
