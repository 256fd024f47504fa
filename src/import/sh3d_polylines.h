// Lines of the plan that are shown in 3D.
#pragma once

#include "import/sh3d_draft.h"
#include "import/sh3d_home.h"
#include "import/sh3d_paints.h"

namespace roomlight::importers::sh3d {

// Flat bands of the line's thickness on its elevation, at least 0.5 mm above its level's; square at ends and corners.
// Throws Failure.
void addPolylines(const Home& home, Paints& paints, Draft& draft);

}  // namespace roomlight::importers::sh3d
