// A scene in another unit, or elsewhere.
#pragma once

#include "scene/scene.h"

namespace roomlight {

// All lengths times s: placements, media, lamps, rooms and cameras. Meshes keep their own coordinates, lights their
// candela and lux.
void scaleScene(Scene& scene, float s);

// Everything that has a place, by this much.
void moveScene(Scene& scene, Vec3 by);

}  // namespace roomlight
