// Meter files, version 1 (docs/reference/meters.md):
//   { "version": 1, "comment", "border": 0.5, "spacing": 0.25, "maintenanceFactor": 0.8, "groundReflectance": 0.2,
//     "rooms": [ { "name", "use", "floor": [[x, z], ..], "elevation", "height", "workPlane",
//                  "surfaces": ["workPlane", "floor", "walls"], "watts", targets } ],
//     "grids": [ { "name", "corner": [x,y,z], "u": [..], "v": [..], targets } ],
//     "points": [ { "name", "position", "normal", "target" } ],
//     "spots": [ { "name", "position", "direction" | "lookAt", "angle" } ],
//     "glare": [ { "name", "position", "direction" | "lookAt", "ugr" } ] }
//   targets: "target": "150 lx", "uniformity": 0.6, "ugr": 19, "powerDensity": 6
#include "measure/meter_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "json/json_file.h"
#include "json/json_reader.h"
#include "scene/outline.h"

namespace roomlight {
namespace {

constexpr double kFarthestM = 1e5, kMostLux = 1e9;
constexpr size_t kMostCorners = 1000, kMostEntries = 10'000;
constexpr const char* kThisFile = "meter file";
constexpr double kLeastAreaM2 = 0.01;

Vec3 place(const JsonPlace& j) { return j.vector(-kFarthestM, kFarthestM); }

Vec3 unit(const JsonPlace& j, Vec3 v) {
  const float l = length(v);
  if (l > 1e-6f) return v / l;
  j.fail("must not be zero");
  return {0, -1, 0};
}

Vec3 direction(const JsonPlace& j, Vec3 from) {
  if (j.has("direction") == j.has("lookAt")) {
    j.fail("give exactly one of direction, lookAt");
    return {0, 0, -1};
  }
  return j.has("direction") ? unit(j["direction"], place(j["direction"]))
                            : unit(j["lookAt"], place(j["lookAt"]) - from);
}

// What the file says goes before what a standard says.
void readTargets(const JsonPlace& j, Targets& targets) {
  if (j.has("target")) targets.lux = Target{j["target"].quantity(Unit::Lux, 0.01, kMostLux), kThisFile};
  if (j.has("uniformity")) targets.uniformity = Target{j["uniformity"].number(0, 1), kThisFile};
  if (j.has("ugr")) targets.ugr = Target{j["ugr"].number(0, 50), kThisFile};
  if (j.has("powerDensity")) targets.wattsPerM2 = Target{j["powerDensity"].number(0, 1e4), kThisFile};
}

std::vector<Vec2> readFloor(const JsonPlace& j) {
  std::vector<Vec2> floor;
  const size_t corners = j.arraySize();
  if (corners < 3 || corners > kMostCorners) {
    j.fail(fmt::format("must have from 3 to {} corners", kMostCorners));
    return floor;
  }
  for (size_t i = 0; i < corners; ++i) {
    if (j[i].arraySize() != 2) {
      j[i].fail("must be [x, z]");
      return floor;
    }
    floor.push_back({static_cast<float>(j[i][size_t{0}].number(-kFarthestM, kFarthestM)),
                     static_cast<float>(j[i][size_t{1}].number(-kFarthestM, kFarthestM))});
  }
  const double area = signedAreaM2(floor);
  if (std::abs(area) < kLeastAreaM2) j.fail("has no area");
  if (crossesItself(floor)) j.fail("crosses itself; list its corners in turn along the walls");
  if (area < 0) std::reverse(floor.begin(), floor.end());
  return floor;
}

Room knownRoom(const JsonPlace& j, const std::string& name, std::span<const Room> sceneRooms) {
  for (const Room& r : sceneRooms) {
    if (r.name == name) return r;
  }
  std::string names;
  for (const Room& r : sceneRooms) names += (names.empty() ? "" : ", ") + r.name;
  if (!j.has("floor"))
    j.fail(fmt::format("the scene knows no room '{}'{}; give its 'floor' as a list of [x, z]", name,
                       names.empty() ? "" : " (it knows " + names + ")"));
  Room room;
  room.name = name;
  return room;
}

RoomPlan readRoom(const JsonPlace& j, std::span<const Room> sceneRooms) {
  if (!j.isObject({"name", "use", "floor", "elevation", "height", "workPlane", "surfaces", "watts", "target",
                   "uniformity", "ugr", "powerDensity"}))
    return {};
  Room room = knownRoom(j, j["name"].text(), sceneRooms);
  if (j.has("use")) {
    room.use = j["use"].text();
    std::string known;
    for (const RoomUse& use : roomUses()) known += (known.empty() ? "" : ", ") + use.name;
    if (!findRoomUse(room.use))
      j["use"].fail(
          fmt::format("unknown '{}'; there are {}; leave it out and give 'target'", room.use.substr(0, 60), known));
  }
  if (j.has("floor")) room.floor = readFloor(j["floor"]);
  room.elevationM =
      static_cast<float>(j.number("elevation", -kFarthestM, kFarthestM, static_cast<double>(room.elevationM)));
  room.heightM = static_cast<float>(j.number("height", 0.1, 1000, static_cast<double>(room.heightM)));
  RoomPlan plan = planRoom(room);
  plan.workPlaneM = j.number("workPlane", 0, 100, plan.workPlaneM);
  if (plan.workPlaneM >= static_cast<double>(room.heightM))
    j[j.has("workPlane") ? "workPlane" : "height"].fail(
        "the work plane must lie below the ceiling; give the room's 'height'");
  plan.wattsW = j.number("watts", 0, 1e7, 0);
  readTargets(j, plan.targets);
  if (j.has("surfaces")) {
    plan.onWorkPlane = false;
    const JsonPlace list = j["surfaces"];
    if (list.arraySize() == 0) list.fail("names no surface; there are workPlane, floor, walls");
    for (size_t i = 0; i < list.arraySize(); ++i) {
      const std::string s = list[i].oneOf({"workPlane", "floor", "walls"});
      (s == "workPlane" ? plan.onWorkPlane : s == "floor" ? plan.onFloor : plan.onWalls) = true;
    }
  }
  return plan;
}

GridPlan readGrid(const JsonPlace& j) {
  GridPlan grid;
  if (!j.isObject({"name", "corner", "u", "v", "target", "uniformity"})) return grid;
  grid.name = j["name"].text();
  grid.corner = place(j["corner"]), grid.alongU = place(j["u"]), grid.alongV = place(j["v"]);
  const float u = length(grid.alongU), v = length(grid.alongV);
  if (u < 1e-3f || v < 1e-3f || std::abs(dot(grid.alongU, grid.alongV)) > 1e-3f * u * v)
    j.fail("'u' and 'v' must be the sides of a rectangle, from 'corner' on");
  readTargets(j, grid.targets);
  return grid;
}

PointPlan readPoint(const JsonPlace& j) {
  PointPlan point;
  if (!j.isObject({"name", "position", "normal", "target"})) return point;
  point.name = j["name"].text();
  point.place.position = place(j["position"]);
  if (j.has("normal")) point.place.normal = unit(j["normal"], place(j["normal"]));
  readTargets(j, point.targets);
  return point;
}

Gaze readGaze(const JsonPlace& j) {
  Gaze gaze{j["name"].text(), place(j["position"]), {}};
  gaze.direction = direction(j, gaze.position);
  return gaze;
}

SpotPlan readSpot(const JsonPlace& j) {
  SpotPlan spot;
  if (!j.isObject({"name", "position", "direction", "lookAt", "angle"})) return spot;
  static_cast<Gaze&>(spot) = readGaze(j);
  spot.angleDeg = j.number("angle", 0.1, 90, 1);
  return spot;
}

GlarePlan readGlare(const JsonPlace& j) {
  GlarePlan glare;
  if (!j.isObject({"name", "position", "direction", "lookAt", "ugr"})) return glare;
  static_cast<Gaze&>(glare) = readGaze(j);
  readTargets(j, glare.targets);
  return glare;
}

// Readings are told apart by the names of their rooms.
void refuseTwins(const JsonPlace& j, const std::vector<RoomPlan>& rooms) {
  std::set<std::string> names;
  for (size_t i = 0; i < rooms.size(); ++i) {
    if (!names.insert(rooms[i].room.name).second)
      j["rooms"][i].fail(fmt::format("is the second room named '{}'", rooms[i].room.name));
  }
}

template <class Read>
auto readList(const JsonPlace& j, const char* key, Read&& read) {
  std::vector<decltype(read(j))> list;
  if (!j.has(key)) return list;
  const JsonPlace entries = j[key];
  const size_t count = entries.arraySize();
  if (count > kMostEntries) entries.fail(fmt::format("has more than {} entries", kMostEntries));
  for (size_t i = 0; i < std::min(count, kMostEntries); ++i) list.push_back(read(entries[i]));
  return list;
}

}  // namespace

Result<MeterPlan> readMeterFile(const std::filesystem::path& file, std::span<const Room> sceneRooms) {
  const Result<nlohmann::json> document = readJsonFile(file);
  if (!document) return Error{document.error()};
  std::string error;
  const JsonPlace j(document.value(), "", error);
  MeterPlan plan;
  if (j.isObject({"version", "comment", "border", "spacing", "maintenanceFactor", "groundReflectance", "rooms", "grids",
                  "points", "spots", "glare"})) {
    plan.grid.spacingM = j.number("spacing", 0.01, 100, 0);
    if (j.has("border")) plan.grid.borderM = j["border"].number(0, 10), plan.grid.borderShare = 0.45;
    plan.maintenanceFactor = j.number("maintenanceFactor", 0.1, 1, 1);
    plan.groundReflectance = j.number("groundReflectance", 0, 1, 0.2);
    if (j.has("version") && j["version"].number(1, 1e6) != 1) j["version"].fail("must be 1");
    if (j.has("comment")) j["comment"].text();
    plan.rooms = readList(j, "rooms", [&](const JsonPlace& room) { return readRoom(room, sceneRooms); });
    refuseTwins(j, plan.rooms);
    plan.grids = readList(j, "grids", readGrid);
    plan.points = readList(j, "points", readPoint);
    plan.spots = readList(j, "spots", readSpot);
    plan.glares = readList(j, "glare", readGlare);
    // What holds for all rooms may stand alone.
    const bool ofAll = j.has("border") || j.has("spacing") || j.has("maintenanceFactor") || j.has("groundReflectance");
    if (plan.empty() && !ofAll) j.fail("asks for nothing; give at least one of rooms, grids, points, spots, glare");
  }
  if (!error.empty()) return Error{fmt::format("{}: {}", file.string(), error)};
  return plan;
}

RoomPlan planRoom(const Room& room) {
  RoomPlan plan;
  plan.room = room;
  if (const RoomUse* use = findRoomUse(room.use)) plan.targets = use->targets, plan.workPlaneM = use->workPlaneM;
  return plan;
}

}  // namespace roomlight
