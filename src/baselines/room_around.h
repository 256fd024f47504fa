// Where techniques that are finest about one place begin: the room of the eye.
#pragma once

#include "trace/ray_scene.h"

namespace roomlight {

// What surrounds `eye`, as far as the first surfaces in all directions, and the eye itself, which may be outside of all
// it sees; a few of the farthest surfaces are left out.
Bounds3 roomAround(const RayScene& rays, Vec3 eye);

}  // namespace roomlight
