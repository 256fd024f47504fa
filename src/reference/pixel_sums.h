// What the filter needs of a pixel, from samples one after the other.
#pragma once

#include "filter/filter.h"

namespace roomlight {

class PixelSums {
 public:
  void add(const FilterPixel& sample);  // variances in it are not read
  // Of `samples` added; variances are those of the means. One sample alone counts as uncertain by as much as it is
// bright.
  FilterPixel mean(int samples) const;

 private:
  FilterPixel sum_;
  // Sums of products of luminances: of diffuse, sharp and specular light and of albedo.
  float diffuse2_ = 0, diffuseAlbedo_ = 0, sharp2_ = 0, sharpAlbedo_ = 0, specular2_ = 0, albedo2_ = 0;
};

}  // namespace roomlight
