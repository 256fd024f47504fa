// LDR-FLIP: Andersson, Nilsson, Akenine-Möller, Oskarsson, Åström, Fairchild 2020, "FLIP: A difference evaluator for
// alternating images". What a viewer sees who flips between the two pictures.
#pragma once

#include "compare/plane.h"

namespace roomlight {

// Per pixel, 0 (no visible difference) .. 1. Inputs linear Rec.709 in 0..1, same size.
Plane flipDifference(const Image& reference, const Image& picture, double pixelsPerDegree = 67);

}  // namespace roomlight
