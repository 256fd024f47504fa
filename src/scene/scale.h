// A scene in another unit.
#pragma once

#include "scene/scene.h"

namespace roomlight {

// All lengths times s: placements, media, lamps, rooms and cameras. Meshes keep their own coordinates, lights their candela and lux.
void scaleScene(Scene& scene, float s);

}  // namespace roomlight
