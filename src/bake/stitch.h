// Closes slits between surfaces: where a vertex of one lies on an edge of another, chips leave out pixels through which
// what is behind sparkles.
#pragma once

#include <span>

#include "bake/batch.h"

namespace roomlight::bake {

// Vertices less than a quarter of a millimetre apart come together, and triangles with one on an edge are split there.
// Of triangles lit by texels alone: what lies between vertices that have light of their own is not known.
void stitch(std::span<Batch* const> batches);

}  // namespace roomlight::bake
