// How far a picture is from a reference of the same view: error measures and a picture of the difference.
#pragma once

#include <optional>

#include "base/image.h"
#include "base/result.h"
#include "compare/perceived_error.h"

namespace roomlight {

// Both pictures linear. For mse, ssim, flip and the difference picture both are exposed alike, by the automatic
// exposure of the reference, clipped to 0..1 and sRGB-encoded: what a viewer sees, without a tone curve.
struct Report {
  double mse = 0;     // mean of squared differences over all pixels and channels of the encoded pictures; 0 is equal
  double relMse =
      0;  // mean over pixels and channels of (p - r)² / (r² + 0.01 m²), linear; m: the reference's mean luminance
  double ssim = 1;    // structural similarity of encoded luma (Wang et al. 2004); 1 is equal
  double flip = 0;    // mean LDR-FLIP (Andersson et al. 2020) at 67 pixels per degree; 0 is equal, 1 at most
  double meanLuminanceErrorPercent = 0;  // 100 (mean luminance of picture / that of reference - 1); signed
  double referenceMeanLuminance = 0;     // in the unit of the pictures, cd/m²
  float ev100 = 0;                       // the exposure used
  // With two references: what mse would be without their noise. With a and b independent, the mean of (a - p)(b - p) is
  // free of both variances. May be slightly negative.
  std::optional<double> mseBeyondNoise;
  std::optional<Blotches> noise;  // with two references: what smooth surfaces have of it
};

// The error that pictures of different sizes are: no figure compares them.
Status checkSizes(ImageSize reference, ImageSize picture);

// Errors: sizes differ, no pixels, a value that is not finite (says which pixel), a black reference.
// Cost: about 0.3 s for a million pixels on two cores, nearly all of it FLIP.
Result<Report> compare(const Image& reference, const Image& picture);

// Of pictures that are exposed and tone-mapped already (.png, .jpg): what is shown, as in the files. How much light
// there was they no longer tell, so that there is no relMse and no error of the mean luminance. Both pictures decoded
// from sRGB to linear, as readImage() gives them.
struct ShownReport {
  double mse = 0, ssim = 1, flip = 0;  // as in Report, without an exposure
};
// Errors: as of compare(), but for black ones.
Result<ShownReport> compareShown(const Image& reference, const Image& picture);

// Against the mean of two references of the same view that were rendered independently (other seeds, equal effort).
Result<Report> compare(const Image& reference, const Image& second, const Image& picture);
Image meanOf(const Image& a, const Image& b);  // of equal size

// Where the picture is too bright (red) or too dark (blue), display-encoded: mid-grey is equal; full colour is a
// difference of 0.25 in encoded luma. For pairs that compare() accepts.
Image differencePicture(const Image& reference, const Image& picture);
// The same of pictures that compareShown() accepts.
Image differencePictureOfShown(const Image& reference, const Image& picture);

}  // namespace roomlight
