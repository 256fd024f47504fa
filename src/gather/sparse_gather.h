// One pixel in many gathers light, by as many times the estimates; the filter gives it to the others. Each has its own
// camera rays, sharp shadows and reflections of smooth surfaces. (Ward, Rubinstein & Clear 1988 gather sparsely and
// interpolate; Kopf et al. 2007 upsample by what pixels see.)
#pragma once

#include "gather/pixel_shader.h"

namespace roomlight {

struct Rectangle {
  int x0, y0, x1, y1;
};

// What a tile's pixels have seen by `rays` camera rays each, before it is lit. Pixels on edges and contacts gather for
// themselves.
void gatherSparsely(TileWork& work, const Rectangle& tile, uint32_t every, float rayRoughness, uint32_t rays,
                    const FilterInput& sums);

}  // namespace roomlight
