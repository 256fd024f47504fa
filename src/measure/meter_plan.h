// What shall be measured, and what rooms should be lit to, as plain data. Filled from a meter file, from the command
// line, or from what the scene knows of its rooms.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/result.h"
#include "measure/lattice.h"
#include "scene/scene.h"

namespace roomlight {

// What rooms should be lit to.
struct Target {
  double value = 0;
  std::string source;  // the standard, or the file that says so
};

struct Targets {
  std::optional<Target> lux;         // at least, on average on the work plane
  std::optional<Target> uniformity;  // U0 at least
  std::optional<Target> ugr;         // at most
  std::optional<Target> wattsPerM2;  // at most
};

struct RoomUse {
  std::string name;  // "living"
  Targets targets;
  double workPlaneM;  // above the floor, where the standard measures
};

// Homes after GB 50034 (general lighting, on 0.75 m, of halls and stairs on the floor; power density of homes), offices
// after EN 12464-1.
const std::vector<RoomUse>& roomUses();
const RoomUse* findRoomUse(const std::string& name);
// What a room's name says of its use, in English, German, French, Italian and Spanish: "Kitchen 2", "Küche", "Salle de
// bain". Null: nothing.
const RoomUse* useByName(const std::string& name);

constexpr double kWorkPlaneM = 0.85;  // above the floor, where nothing says otherwise (EN 17037)

struct RoomPlan {
  Room room;
  Targets targets;
  double workPlaneM = kWorkPlaneM;
  bool onWorkPlane = true, onFloor = false, onWalls = false;
  double wattsW = 0;  // installed; 0: as the lamps inside state
};

struct GridPlan {  // a rectangle anywhere, such as a worktop
  std::string name;
  Vec3 corner, alongU, alongV;  // light falls on the side of cross(alongU, alongV)
  Targets targets;
};

struct PointPlan {
  std::string name;
  SurfaceElement place;
  Targets targets;
};

// Who looks from a place in a direction.
struct Gaze {
  std::string name;
  Vec3 position, direction{0, 0, -1};  // unit
};

struct SpotPlan : Gaze {
  double angleDeg = 1;  // of the field, a square
};

struct GlarePlan : Gaze {
  Targets targets;
};

struct MeterPlan {
  std::vector<RoomPlan> rooms;
  std::vector<GridPlan> grids;
  std::vector<PointPlan> points;
  std::vector<SpotPlan> spots;
  std::vector<GlarePlan> glares;
  GridSettings grid;
  double maintenanceFactor = 1;  // targets are judged with readings times this: lamps and rooms grow old
  double groundReflectance = 0.2;  // of what lies outside, for daylight factors
  bool empty() const { return rooms.empty() && grids.empty() && points.empty() && spots.empty() && glares.empty(); }
};

// A room measured on its work plane, with the targets of its use.
RoomPlan planRoom(const Room& room);

// The meter file: JSON that says what to measure. Schema: docs/reference/meters.md. Rooms that the file only names are
// those of the scene. Unknown keys, wrong types, missing units and values out of range are errors that name the file
// and the JSON path.
Result<MeterPlan> readMeterFile(const std::filesystem::path& file, std::span<const Room> sceneRooms);

}  // namespace roomlight
