// Walls as closed bodies with their openings.
#pragma once

#include "import/sh3d_draft.h"
#include "import/sh3d_home.h"
#include "import/sh3d_paints.h"

namespace roomlight::importers::sh3d {

// Every wall on a shown level becomes an object: both sides, top, bottom and ends, with the reveals of its openings and
// its baseboards. Walls of upper levels reach down through the slab of their floor. Throws Failure.
void addWalls(const Home& home, Paints& paints, Draft& draft);

}  // namespace roomlight::importers::sh3d
