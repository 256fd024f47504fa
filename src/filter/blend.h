// A picture with little noise but unknown errors, put right by a few unbiased noisy samples a pixel: the combination of
// least estimated squared error (shrinkage after James & Stein; combiners of renderings: Gu et al. 2022, Back et al.
// 2020).
#pragma once

#include "filter/filter.h"

namespace roomlight {

struct Blend {
  Image image;  // linear, in the pictures' unit
  double relativeError =
      0;  // estimate of what is left: root mean square, relative to a pixel's luminance; within a factor of about 4
  double srgbMse = 0;  // the same as compare's mse would have it: exposed automatically and encoded as sRGB
};

// first: of the same view. mean, variance: of independent unbiased samples; variance that of each pixel's mean, a
// channel, from two samples on. guide: what pixels see; only normal, position and surface count.
//
// What the samples say of the first picture's errors is averaged over windows of 3^k pixels a side, as far as they see
// one surface, k = 4 to 0. Each level adds what the coarser ones left, as far as it stands out of its own noise and its
// estimate is certain. With few samples that puts right what is wrong at large; with many every pixel becomes the
// samples' mean. About 0.8 s of one core for 960x540.
Blend blend(const Image& first, const Image& mean, const Image& variance, const FilterInput& guide);

}  // namespace roomlight
