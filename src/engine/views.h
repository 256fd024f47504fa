// Cameras that a home is shown by without anybody having placed one: plans, views from above, panoramas.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/result.h"
#include "scene/scene.h"

namespace roomlight {

enum class View : uint8_t {
  Camera,    // perspective, as placed
  Top,       // perspective, from straight above
  Plan,      // orthographic, from straight above: +x to the right, -z up, as homes are drawn
  Panorama,
  Stereo,
};
Result<View> viewFromName(const std::string& name);  // "camera", "top", "plan", "panorama", "stereo"

// What is asked of a view; what is not said is chosen.
struct ViewWish {
  View view = View::Camera;
  std::string level, room;              // a number from 0, the lowest; a name or a number; empty: chosen
  std::optional<float> cutM;            // height above the level's floor above which nothing is seen
  std::optional<float> metresPerPixel;  // Plan
  std::optional<float> yFovRad;         // Camera, Top
  std::optional<Vec3> eye, target;
  std::optional<bool> emptyBackdrop;    // Top and Plan: true, else false
  std::optional<std::pair<int, int>> size;
};

struct Viewed {
  Camera camera;
  int width = 0, height = 0;
};

constexpr float kLevelsApartM = 0.9f;  // split floors are less apart, storeys more

// Rooms whose floors are less than that apart in height, the lowest level first.
struct Level {
  float elevationM = 0;    // of the lowest floor
  float ceilingM = 0;      // of the lowest ceiling that one can stand under
  Vec2 low, high;          // of the floors, (x, z)
};
std::vector<Level> levelsOf(std::span<const Room> rooms);

// `rooms`: those of the scene, or found in it; with none, top and plan show the whole of the scene. `placed`: the
// camera that was chosen or stands in for one; `isPlaced`: somebody did, so that panoramas are taken from there rather
// than from the middle of a room. `usual`: size of a picture of View::Camera. Errors name the option that asks for what
// there is not.
Result<Viewed> makeView(const Scene& scene, std::span<const Room> rooms, const Camera& placed, bool isPlaced,
                        std::pair<int, int> usual, const ViewWish& wish);

// The point of a floor farthest from its edges, to 5 % of its size.
Vec2 middleOf(const Room& room);

// Elevation of the floor that a cut camera shows: the highest of the rooms' that lies below the cut. None without a cut
// or rooms.
std::optional<float> shownFloorM(const Scene& scene, const Camera& camera);

// Whether each pixel shows a room or its walls, of a camera that cuts a scene with rooms: what a plan is exposed by,
// instead of the garden around it. Empty for other pictures.
std::vector<bool> roomMask(const Scene& scene, const Camera& camera, int width, int height);

}  // namespace roomlight
