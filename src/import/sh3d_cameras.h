// Cameras of a home.
#pragma once

#include "import/sh3d_home.h"
#include "import/warnings.h"
#include "scene/scene.h"

namespace roomlight::importers::sh3d {

// The one that is on comes first, then the other of observer and top, then the stored ones by their names.
void addCameras(const Home& home, Scene& scene, Warnings& warnings);

// The one whose time of day counts: that of this name or number, where it has a time; otherwise the one that is on, or
// the first. None where the home has none.
const Camera* cameraOfTime(const Home& home, const std::string& wanted);

}  // namespace roomlight::importers::sh3d
