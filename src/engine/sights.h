// How much of each pixel is no light: sections of what a camera cuts, and an empty backdrop.
#pragma once

#include <optional>
#include <vector>

#include "base/image.h"
#include "trace/camera_rays.h"

namespace roomlight {

// Shares of each pixel, 0 to 1; both empty for cameras that neither cut nor have an empty backdrop. Where they are
// above 0 a picture's light is that of the rest of the pixel times the share of the rest.
struct Sights {
  std::vector<float> section, backdrop;
};

// One ray a pixel, and 16 where a neighbour's sees something else.
Sights sightsOf(const RayScene& rays, const Camera& camera, int width, int height);

// Light of the rest of each pixel alone.
Image unmixed(const Image& light, const Sights& sights);
// A display-encoded picture of the rest with the sections drawn in, over a backdrop, or for a writer who knows opacity
// without one.
Image drawn(const Image& encoded, const Sights& sights, Vec3 section, std::optional<Vec3> backdrop);

}  // namespace roomlight
