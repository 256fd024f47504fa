// Diffuse light by levels: what a smooth picture of its surfaces shows, and what each finer level adds to that. Levels
// are means by surfaces alone (hats, twice as wide each: the à-trous wavelet transform, Starck & Murtagh 1994), so
// noise goes through them as through any linear filter, and one draw of it tells how much of a level it makes up around
// a pixel. As much of each level is kept as stands out of that (Wiener's gain): clouds of noise go at every size;
// slopes, soft shadows and contacts stay.
//
// Openness (FilterPixel::open) goes through the same levels. Where light changes with it, by a regression around each
// pixel, so much of a level is kept as that tells, however noisy light is: contacts, corners and what stands before
// walls (after Moon et al. 2014, "Adaptive rendering based on weighted local regression", and Bitterli et al. 2016,
// "Nonlinearly weighted first-order regression for denoising Monte Carlo renderings").
#pragma once

#include "filter/filter_kernel.h"

namespace roomlight {

// Called by filter.cpp after each pass: takePower, pooling; of levels with outliers boundPower, pooling; keepLevel.
// After the last pass addKept; takeNoise, pooling. `place`: which of the two places of diffuse light holds the finer
// picture; the other holds the smoother one.
//
// Level 0 is what single pixels add. In the finest single pixels may be outliers, so their power is bounded.
bool hasOutliers(int level);
// Plus or minus the root of `variance`, by a hash of the pixel: the same each time.
float drawnNoise(float variance, size_t pixel);
// Power of a level in row y, and of the noise in it, for pooling.
void takePower(FilterRows& rows, int place, int y);
// The power once more, of each pixel no more than a few times the noise pooled around it; weights by samples and by the
// noise close by, which is in the second pool.
void boundPower(FilterRows& rows, int place, int y);
// Adds what stands out of noise there to what is kept. Pooled powers are in the first pool.
void keepLevel(FilterRows& rows, int level, int place, int y);
// Puts all that is kept on top of the smoothest picture, at `place`.
void addKept(FilterRows& rows, int place, int y);
// The square of the noise left then, for pooling.
void takeNoise(FilterRows& rows, int place, int y);

}  // namespace roomlight
