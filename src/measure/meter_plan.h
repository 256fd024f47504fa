// What shall be measured, as plain data. Filled from a meter file, from the command line, or from what the scene knows
 // of its rooms.
#pragma once

#include <string>
#include <vector>

#include "measure/lattice.h"
#include "measure/targets.h"
#include "scene/scene.h"

namespace roomlight {

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
  double maintenanceFactor = 1;    // targets are judged with readings times this: lamps and rooms grow old
  double groundReflectance = 0.2;  // of what lies outside, for daylight factors
  bool empty() const { return rooms.empty() && grids.empty() && points.empty() && spots.empty() && glares.empty(); }
};

// A room measured on its work plane, with the targets of its use.
RoomPlan planRoom(const Room& room);

}  // namespace roomlight
