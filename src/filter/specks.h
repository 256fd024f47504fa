// Single pixels that no pass could make like their neighbours.
#pragma once

#include "filter/filter_kernel.h"

namespace roomlight {

// Of row y, from the places where a pass over it reads to the others: diffuse, rare and specular light within what the
// pixels beside show of it, where enough of these lie on one surface with it. So lone bright and dark pixels go, and
// edges and lines stay. Light of mirrors is a picture and stays as it is.
void boundSpecks(FilterRows& rows, const FilterPass& pass, int y);
constexpr bool hasSpecks(int light) { return light != 1; }  // the edges of sharp light are its own

}  // namespace roomlight
