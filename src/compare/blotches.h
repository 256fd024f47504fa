// Noise as eyes see it on smooth surfaces: blotches of 4 to 32 pixels and grain of 1.5 to 4, which mse hardly tells.
#pragma once

#include "base/image.h"
#include "compare/plane.h"

namespace roomlight {

constexpr float kNotJudged = 1e9f;

struct Blotches {
  double blotchesPercent = 0;  // eyes see 1 % on a wall
  double grainPercent = 0;
  double judgedShare = 0;  // of all pixels; 0: the two figures say nothing
  Plane band;  // relative error in the band of blotches, signed; kNotJudged where there are edges or lamps
};

// Linear pictures of one size; references independent of each other. With e = (picture - reference) / (r + 0.02 mean
// r), r the mean of both references, clamped to +-1: the difference of e under normalised Gaussians of 4 and of 32
// pixels (1.5 and 4: grain), against either reference; the root of the mean of their product is free of the references'
// noise. Judged are pixels darker than 20 medians (of what is not black) with no edge within some 4 pixels: there log
// luminance spans less than 0.5 in 9 x 9 of r under a Gaussian of 2 pixels, and less than 0.4 in 7 x 7 of the picture.
// About 0.5 s of two cores for 960x540.
Blotches blotches(const Image& reference, const Image& second, const Image& picture);

// The band, display-encoded: mid-grey is right, full red 5 % too bright, full blue 5 % too dark; black is not judged.
Image bandPicture(const Blotches& found);

}  // namespace roomlight
