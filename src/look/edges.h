// Pixels on the edge of something much brighter. A curve over their mean would show a window's edge as steps: one
// twentieth of a sky is white already. They are shown as the mean of what is shown of both sides instead.
#pragma once

#include <cstdint>
#include <vector>

#include "base/image.h"

namespace roomlight {

// A pixel that lies between its brightest neighbour and those opposite of it.
struct EdgePixel {
  size_t pixel, bright, dark;  // indices into the picture
  float share;                 // of the pixel that the bright side covers
  float weight;                // 0 to 1: how far it is shown so; contrasts of less than 2 are shown as they are
  float darkLuminance;
  Vec3 rest;  // light of what the bright side does not cover
};
std::vector<EdgePixel> edgePixels(const Image& light);

// `shown`: of that picture, encoded; `rests`: of the rests, encoded, one a pixel.
void showEdges(Image& shown, const std::vector<EdgePixel>& edges, const Image& rests);

}  // namespace roomlight
