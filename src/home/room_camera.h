// Where a photographer would stand in a room.
#pragma once

#include <optional>

#include "trace/ray_scene.h"

namespace roomlight::home {

struct RoomView {
  Camera camera;
  double score = 0;  // 0 to about 1: how much of the picture is 1 to 6 m away, and how much of the room it shows
};

// At eye height, level, where most of the room is seen at 1 to 6 m and nothing is closer than half a metre; also from
// beside the room, where it is open to a side. None where nobody could stand.
std::optional<RoomView> viewOf(const RayScene& rays, const Room& room);

}  // namespace roomlight::home
