#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "base/utf8.h"
#include "import/sh3d_wall_parts.h"
#include "scene/outline.h"

namespace roomlight::importers::sh3d {
namespace {

constexpr int kPlaces = 9, kLeastPlaces = 2;  // along a side, where rooms are looked for
constexpr double kBesideCm = 10;              // off the side's surface: outlines of rooms may lie within walls
constexpr size_t kMostWork = 20'000'000;      // corners of rooms, for each wall
constexpr std::array kBearings = {"north", "north-east", "east", "south-east",
                                  "south", "south-west", "west", "north-west"};

struct RoomPlan {
  std::vector<Vec2> outline;  // cm
  Vec2 lo{kInfinity, kInfinity}, hi{-kInfinity, -kInfinity};
  int level = -1;
  std::string name;

  bool holds(Vec2 p) const { return p.x >= lo.x && p.x <= hi.x && p.y >= lo.y && p.y <= hi.y && contains(outline, p); }
};

std::vector<RoomPlan> roomPlans(const Home& home) {
  constexpr size_t kLongest = 60;
  std::vector<RoomPlan> rooms;
  size_t corners = 0;
  for (const Room& r : home.rooms) {
    RoomPlan& room = rooms.emplace_back();
    room.level = r.level, room.name = r.name.empty() ? "room" : printable(r.name, kLongest);
    for (const PlanPoint& p : r.points) {
      const Vec2 q{static_cast<float>(p.x), static_cast<float>(p.y)};
      room.outline.push_back(q);
      room.lo = {std::min(room.lo.x, q.x), std::min(room.lo.y, q.y)};
      room.hi = {std::max(room.hi.x, q.x), std::max(room.hi.y, q.y)};
    }
    corners += 1 + r.points.size();
  }
  if (corners * home.walls.size() > kMostWork) rooms.clear();
  return rooms;
}

// One side of a wall: the room along most of it, -1: none, and the way that it looks on the plan.
struct Beside {
  int room = -1;
  PlanPoint way;
};

Beside besideOf(const PlanRing& side, bool left, int level, const std::vector<RoomPlan>& rooms) {
  Beside out;
  std::map<int, int> places;  // by room
  for (int k = 0; k < kPlaces; ++k) {
    const double along = (k + 0.5) / kPlaces * static_cast<double>(side.size() - 1);
    const size_t i = std::min(static_cast<size_t>(along), side.size() - 2);
    const double t = along - static_cast<double>(i), x = side[i + 1].x - side[i].x, y = side[i + 1].y - side[i].y,
                 length = std::hypot(x, y);
    if (!(length > 0)) continue;
    const double sign = (left ? 1 : -1) / length;
    const PlanPoint way{sign * y, -sign * x};
    out.way.x += way.x, out.way.y += way.y;
    const Vec2 p{static_cast<float>(side[i].x + t * x + kBesideCm * way.x),
                 static_cast<float>(side[i].y + t * y + kBesideCm * way.y)};
    // The later room of the file lies on top.
    for (size_t r = rooms.size(); r-- > 0;) {
      if (rooms[r].level != level || !rooms[r].holds(p)) continue;
      ++places[static_cast<int>(r)];
      break;
    }
  }
  int most = kLeastPlaces - 1;
  for (const auto& [room, count] : places) {
    if (count > most) most = count, out.room = room;
  }
  return out;
}

// Angles run clockwise from up on the plan; y points down there.
std::string bearingOf(PlanPoint way, double northRad) {
  const double turn = (std::atan2(way.x, -way.y) - northRad) / (2 * std::numbers::pi);
  return kBearings[static_cast<size_t>(std::lround((turn - std::floor(turn)) * 8)) % kBearings.size()];
}

std::string labelOf(const Home& home, const std::vector<RoomPlan>& rooms, const Beside& left, const Beside& right) {
  const auto name = [&](int room) { return rooms[static_cast<size_t>(room)].name; };
  const int first = std::min(left.room, right.room), second = std::max(left.room, right.room);
  if (second < 0) return "Wall";
  if (first == second) return "Wall in " + name(first);
  if (first >= 0) return fmt::format("Wall between {} and {}", name(first), name(second));
  const PlanPoint out = left.room >= 0 ? right.way : left.way;
  return home.compass ? fmt::format("Wall, {}, {}", name(second), bearingOf(out, home.compass->northRad))
                      : "Wall, " + name(second);
}

}  // namespace

std::vector<std::string> wallLabels(const Home& home, const std::vector<WallOutline>& outlines) {
  const std::vector<RoomPlan> rooms = roomPlans(home);
  std::vector<std::string> labels(home.walls.size());
  std::map<std::string, size_t> counts;
  std::set<std::string> used;
  for (size_t i = 0; i < labels.size(); ++i) {
    const WallOutline& outline = outlines[i];
    if (outline.left.size() < 2 || outline.right.size() < 2) continue;  // not shown
    const int level = home.walls[i].level;
    labels[i] =
        labelOf(home, rooms, besideOf(outline.left, true, level, rooms), besideOf(outline.right, false, level, rooms));
    const std::string plain = labels[i];
    while (!used.insert(labels[i]).second) labels[i] = fmt::format("{} ({})", plain, ++counts[plain] + 1);
  }
  return labels;
}

}  // namespace roomlight::importers::sh3d
