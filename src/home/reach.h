// The part of a large scene whose light is likely to come to cameras. The rest of an apartment house costs time and
 // memory and hardly changes the picture.
#pragma once

#include <optional>
#include <span>

#include "trace/ray_scene.h"

namespace roomlight::home {

// The scene without triangles and lamps in places that no path of light from a camera comes near: of some ten thousand
// paths a camera with four diffuse bounces, each of which looks for the suns, for one of the lamps, and through panes,
// and a cell around them (a 64th of the scene, at least a metre). None where that would leave out less than two thirds
// of the surfaces, or the scene is no larger than a home. Objects and materials keep their numbers, instances do not.
std::optional<Scene> withinReach(const RayScene& rays, std::span<const Camera> cameras);

}  // namespace roomlight::home
