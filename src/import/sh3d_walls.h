// Walls as closed bodies with their openings.
#pragma once

#include "import/sh3d_effort.h"
#include "import/sh3d_home.h"
#include "import/sh3d_paints.h"
#include "import/warnings.h"
#include "scene/scene.h"

namespace roomlight::importers::sh3d {

// Every wall on a shown level becomes an object: both sides, top, bottom and ends, with the reveals of its openings and
// its baseboards. Walls of upper levels reach down through the slab of their floor. `object` is the first free number
// and ends behind the last one used.
void addWalls(const Home& home, Paints& paints, Scene& scene, int& object, Effort& effort, Warnings& warnings);

}  // namespace roomlight::importers::sh3d
