// The colour of the light that falls on what a picture shows.
#pragma once

#include "base/image.h"
#include "trace/ray_scene.h"

namespace roomlight {

// Mean of luminance over albedo on opaque surfaces that do not shine themselves, by camera rays on a raster: what a
// white card would show there. So coloured walls do not count as coloured light, except for what they reflect on to
// others. Of no size but a colour; black where nothing tells.
Vec3 lightColour(const RayScene& rays, const Camera& camera, const Image& image, int raysASide = 64);

}  // namespace roomlight
