// Cameras for scenes that have none, or whose own see nothing.
#pragma once

#include <string>
#include <vector>

#include "trace/ray_scene.h"

namespace roomlight::home {

// In the order in which they should be shown: rooms by what is to be seen in them and whether they are lit, named after
// them; "Outside", a three-quarter view of the whole; "Plan", from above, of a home with rooms. A scene without rooms
// has only "Outside". `lightComes`: whether there is light out of doors; rooms are lit by that or by lamps in them.
// Costs some ten thousand rays a room.
std::vector<Camera> proposeCameras(const RayScene& rays, const std::vector<Room>& rooms, bool lightComes);

// What is wrong with where a camera of a file stands; empty: nothing.
std::string faultOf(const RayScene& rays, const std::vector<Room>& rooms, const Camera& camera);

}  // namespace roomlight::home
