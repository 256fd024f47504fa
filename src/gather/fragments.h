// What pixels on edges see beside the surface that fills most of them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/image.h"
#include "filter/filter.h"

namespace roomlight {

// What a pixel keeps beside the sums over its camera rays.
struct PixelCount {
  uint32_t rays = 0;
  uint32_t gathered = 0, glossy = 0;  // that diffuse and specular light is known of, each times the estimates it got
  bool edge = false;  // more than one surface seen
  float occlusion = 0;
};
// What pixels see beside the surface that fills most of them: an edge of a thing before a wall. Its diffuse light is
// filtered with that of its own surface.
struct Fragment {
  uint32_t pixel;
  Vec3 diffuse, albedo, normal, position;  // sums over camera rays, as FilterPixel's
  float surface = 0;
};
using Fragments = std::vector<Fragment>;  // of a tile

// Whether light on two surfaces may be filtered together, much as the filter has it. Normals of any length.
bool onOneSheet(Vec3 normal, Vec3 position, Vec3 otherNormal, Vec3 otherPosition);

// Adds their light to a picture that was filtered without them: of pixels around that see the same surface, by their
// irradiance after filtering; where there is none their own.
void addFragments(const Fragments& fragments, const FilterInput& means, const std::vector<PixelCount>& counts,
                  std::span<const Vec3> irradiance, Image& image);

}  // namespace roomlight
