// How far a picture is from a reference.
#pragma once

#include "base/image.h"
#include "base/result.h"

namespace roomlight {

struct Report {
  double mse = 0;      // both exposed as the reference asks, sRGB-encoded, clipped to 0..1; mean squared difference
  double relMse = 0;   // linear: mean of (p - r)² / (r² + 0.01 mean(r)²)
  double ssim = 1;     // of encoded luma, 8x8 windows (Wang et al. 2004)
  double meanLuminanceErrorPercent = 0;  // signed: picture against reference
};

// Errors: sizes differ, a value is not finite.
Result<Report> compare(const Image& reference, const Image& picture);

// Absolute differences of the encoded pictures, four times enlarged; display values.
Image differencePicture(const Image& reference, const Image& picture);

}  // namespace roomlight
