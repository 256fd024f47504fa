// Cameras for scenes that have none, or whose own see nothing; and what cameras see of a scene.
#pragma once

#include <optional>
#include <span>
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

// Where a photographer would stand in a room.
struct RoomView {
  Camera camera;
  double score = 0;  // 0 to about 1: how much of the picture is 1 to 6 m away, and how much of the room it shows
};

// At eye height, level, where most of the room is seen at 1 to 6 m and nothing is closer than half a metre; also from
// beside the room, where it is open to a side. None where nobody could stand.
std::optional<RoomView> viewOf(const RayScene& rays, const Room& room);

// What a camera sees of a scene, by some hundred rays.
struct Seen {
  Vec3 p, n;  // n: towards the camera, unit
  float distanceM = 0;
};

struct Sights {
  std::vector<Seen> surfaces;
  size_t rays = 0;

  double share(float nearM, float farM) const;  // of the picture that shows surfaces as far away
};
Sights sightsOf(const RayScene& rays, const Camera& camera);

// Whether what the camera sees is mostly under roofs: in rooms, or closed in on all sides.
bool isIndoors(const RayScene& rays, const std::vector<Room>& rooms, const Camera& camera, const Sights& sights);

// The part of a large scene whose light is likely to come to cameras. The rest of an apartment house costs time and
// memory and hardly changes the picture. The scene without triangles and lamps in places that no path of light from a
// camera comes near: of some ten thousand paths a camera with four diffuse bounces, each of which looks for the suns,
// for one of the lamps, and through panes, and a cell around them (a 64th of the scene, at least a metre). None where
// that would leave out less than two thirds of the surfaces, or the scene is no larger than a home. Objects and
// materials keep their numbers, instances do not.
std::optional<Scene> withinReach(const RayScene& rays, std::span<const Camera> cameras);

// The height in the world above which a camera that looks down at the home from above it should see nothing
// (Camera::cutHeightM), m: just under the ceilings of the highest level that it then looks into, lower where ceilings
// slope. None for cameras that do not stand above all rooms under an open sky and look down by 30 degrees or more, and
// for homes that are open from above: those cameras see what they always did. Costs a few thousand rays.
std::optional<float> cutHeightFor(const RayScene& rays, const std::vector<Room>& rooms, const Camera& camera);

}  // namespace roomlight::home
