// Structural similarity. Wang, Bovik, Sheikh, Simoncelli 2004, "Image quality assessment: from error visibility to
// structural similarity", equation 13 with its constants, Gaussian window of sigma 1.5 and 11 x 11 pixels.
#pragma once

#include "compare/plane.h"

namespace roomlight {

// Mean over pixels; values in 0..1, same size.
double structuralSimilarity(const Plane& a, const Plane& b);

}  // namespace roomlight
