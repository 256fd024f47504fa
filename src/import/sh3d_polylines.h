// Lines of the plan that are shown in 3D.
#pragma once

#include "import/sh3d_home.h"
#include "import/sh3d_paints.h"
#include "scene/scene.h"

namespace roomlight::importers::sh3d {

// Flat bands of the line's thickness on its elevation, at least 0.5 mm above its level's; square at ends and corners.
void addPolylines(const Home& home, Paints& paints, Scene& scene, int& object);

}  // namespace roomlight::importers::sh3d
