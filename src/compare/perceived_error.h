// Differences between pictures as eyes see them.
#pragma once

#include "base/image.h"
#include "compare/plane.h"

namespace roomlight {

// Structural similarity. Wang, Bovik, Sheikh, Simoncelli 2004, "Image quality assessment: from error visibility to
// structural similarity", equation 13 with its constants, Gaussian window of sigma 1.5 and 11 x 11 pixels.
// Mean over pixels; values in 0..1, same size.
double structuralSimilarity(const Plane& a, const Plane& b);

// LDR-FLIP: Andersson, Nilsson, Akenine-Möller, Oskarsson, Åström, Fairchild 2020, "FLIP: A difference evaluator for
// alternating images". What a viewer sees who flips between the two pictures. Per pixel, 0 (no visible difference) ..
// 1. Inputs linear Rec.709 in 0..1, same size.
Plane flipDifference(const Image& reference, const Image& picture, double pixelsPerDegree = 67);

// Noise as eyes see it on smooth surfaces: blotches of 4 to 32 pixels and grain of 1.5 to 4, which mse hardly tells.
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
