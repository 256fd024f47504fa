// Rooms as they are found in a scene: free space enclosed by surfaces.
#pragma once

#include <vector>

#include "trace/ray_scene.h"

namespace roomlight::home {

// "Room 1", the largest, "Room 2", ... of a scene in metres; each with the outline of its floor, to 20 cm, and the
// height of most of its ceiling. Costs some hundred thousand rays.
std::vector<Room> findRooms(const RayScene& rays);

// Whether p is in the room, between its floor and its ceiling.
bool isIn(const Room& room, Vec3 p);

double areaM2(const Room& room);

// Whether a lamp or something that shines is in the room.
bool hasLight(const Scene& scene, const Room& room);

}  // namespace roomlight::home
