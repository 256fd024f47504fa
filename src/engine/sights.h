// What the pixels of a picture show: how much of each is no light (sections of what a camera cuts, an empty backdrop),
// and the colour of the light on the rest.
#pragma once

#include <optional>
#include <vector>

#include "base/image.h"
#include "trace/camera_rays.h"
#include "trace/ray_scene.h"

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

// The colour of the light that falls on what a picture shows: mean of luminance over albedo on opaque surfaces that do
// not shine themselves, by camera rays on a raster: what a white card would show there. So coloured walls do not count
// as coloured light, except for what they reflect on to others. Of no size but a colour; black where nothing tells.
Vec3 lightColour(const RayScene& rays, const Camera& camera, const Image& image, int raysASide = 64);
// The same of the whole, and what each of the parts, whose sum it is, has in that: they add up to it.
struct LightColours {
  Vec3 whole;
  std::vector<Vec3> parts;
};
LightColours lightColours(const RayScene& rays, const Camera& camera, const Image& whole,
                          const std::vector<const Image*>& parts, int raysASide = 64);

}  // namespace roomlight
