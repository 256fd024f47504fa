// Pixels on the edge of something much brighter. A curve over their mean would show a window's edge as steps: one
// twentieth of a sky is white already. They are shown as the mean of what is shown of both sides instead.
#pragma once

#include <cstdint>
#include <vector>

#include "base/image.h"

namespace roomlight {

// A pixel that lies between its brightest neighbour and those opposite.
struct EdgePixel {
  uint32_t pixel, bright, dark;  // indices into the picture
  float share;                   // of the pixel that the bright side covers
  float weight;                  // 0 to 1: how far it is shown so
  float ownColour;  // 0 to 1: how far the rest has the colour that is left over, not that of the dark side
  Vec3 darkLight;  // of the dark side
  Vec3 rest;  // light of what the bright side does not cover
};

// `light`: before local exposure and glare. Edges of contrast 2 or less are none, from 4 on they are shown so in full.
std::vector<EdgePixel> edgePixels(const Image& light);

// The same edges in other light, such as that of one layer.
std::vector<EdgePixel> edgesIn(const Image& light, std::vector<EdgePixel> edges);

// The rests, one a pixel, after what was done to the picture: `gains` of local exposure (empty: none), and glare.
Image retouchedRests(const std::vector<EdgePixel>& edges, const Plane& gains, const Image& retouched);

// What an edge pixel shows, from what the curve makes of it, of its bright side and of its rest; all encoded.
Vec3 shownEdge(const EdgePixel& edge, Vec3 own, Vec3 bright, Vec3 rest);

// `shown`: of that picture, encoded; `rests`: of the rests, encoded.
void showEdges(Image& shown, const std::vector<EdgePixel>& edges, const Image& rests);

}  // namespace roomlight
