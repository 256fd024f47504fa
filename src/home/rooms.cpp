#include "home/rooms.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/sampling.h"
#include "engine/views.h"
#include "measure/lattice.h"
#include "scene/outline.h"

namespace roomlight::home {
namespace {

constexpr double kPlaneM = 1.2;  // above the floor, over most furniture
constexpr float kEyeM = 1.6f, kNoCeilingM = 2.5f;
constexpr float kMarginM = 0.1f;

struct Cell {
  int column, row;
  auto operator<=>(const Cell&) const = default;
};

// Marks the largest connected part of the used cells.
std::vector<uint8_t> largestPart(const MeterGrid& cells) {
  std::vector<int> part(cells.used.size(), -1);
  std::vector<size_t> sizes;
  for (size_t first = 0; first < part.size(); ++first) {
    if (!cells.used[first] || part[first] >= 0) continue;
    const int number = static_cast<int>(sizes.size());
    std::vector<size_t> open = {first};
    part[first] = number;
    sizes.push_back(0);
    while (!open.empty()) {
      const int column = static_cast<int>(open.back()) % cells.columns,
                row = static_cast<int>(open.back()) / cells.columns;
      open.pop_back();
      ++sizes.back();
      for (const Cell step : {Cell{0, 1}, Cell{1, 0}, Cell{0, -1}, Cell{-1, 0}}) {
        const Cell next{column + step.column, row + step.row};
        if (next.column < 0 || next.row < 0 || next.column >= cells.columns || next.row >= cells.rows) continue;
        const size_t i = cells.index(next.column, next.row);
        if (cells.used[i] && part[i] < 0) part[i] = number, open.push_back(i);
      }
    }
  }
  const auto largest = std::max_element(sizes.begin(), sizes.end()) - sizes.begin();
  std::vector<uint8_t> marked(part.size());
  for (size_t i = 0; i < part.size(); ++i) marked[i] = part[i] == largest ? 1 : 0;
  return marked;
}

// Corners of the outline of the largest connected part, along the borders of cells. Holes are left out.
std::vector<Cell> outlineOf(const MeterGrid& cells) {
  const std::vector<uint8_t> marked = largestPart(cells);
  const auto used = [&](int column, int row) {
    return column >= 0 && row >= 0 && column < cells.columns && row < cells.rows && marked[cells.index(column, row)];
  };
  Cell start{-1, -1};
  for (int row = 0; row < cells.rows && start.row < 0; ++row) {
    for (int column = 0; column < cells.columns && start.row < 0; ++column) {
      if (used(column, row)) start = {column, row};
    }
  }
  std::vector<Cell> corners;
  if (start.row < 0) return corners;
  // Along grid lines from the top left corner of the first cell, which has none above: down its left side, and so on.
  constexpr Cell kSteps[] = {{0, 1}, {1, 0}, {0, -1}, {-1, 0}};  // down, right, up, left
  Cell at = start;
  int heading = 0;
  do {
    const Cell step = kSteps[heading];
    at = {at.column + step.column, at.row + step.row};
    // The cells ahead to the left and to the right of the heading.
    const auto ahead = [&](int side) {
      const Cell s = kSteps[heading];
      const int column = at.column + (s.column > 0 || (s.column == 0 && (s.row > 0) == (side < 0)) ? 0 : -1);
      const int row = at.row + (s.row > 0 || (s.row == 0 && (s.column > 0) == (side > 0)) ? 0 : -1);
      return used(column, row);
    };
    const bool left = ahead(-1), right = ahead(1);
    int turned = heading;
    if (!left)
      turned = (heading + 1) % 4;  // the cells are on the left
    else if (right)
      turned = (heading + 3) % 4;
    if (turned != heading) corners.push_back(at), heading = turned;
  } while (!(at == start && heading == 0) && corners.size() < 100000);
  return corners;
}

// Heights of floor and ceiling over the floor's level, from that of a standing eye, over furniture.
struct Heights {
  std::vector<float> floors, ceilings;
};
Heights heightsIn(const RayScene& rays, const Area& area) {
  Heights heights;
  for (int row = 0; row < area.map.rows; ++row) {
    for (int column = 0; column < area.map.columns; ++column) {
      if (!area.map.used[area.map.index(column, row)]) continue;
      const Vec3 p = area.map.centre(column, row);
      const Vec3 eye{p.x, area.elevationM + kEyeM, p.z};
      const Hit ceiling = rays.intersect({eye, {0, 1, 0}, 0, kInfinity}),
                floor = rays.intersect({eye, {0, -1, 0}, 0, kInfinity});
      if (ceiling.valid()) heights.ceilings.push_back(kEyeM + ceiling.t);
      if (floor.valid()) heights.floors.push_back(kEyeM - floor.t);
    }
  }
  return heights;
}

float medianOf(std::vector<float>& heights, float otherwise) {
  if (heights.empty()) return otherwise;
  const auto middle = heights.begin() + static_cast<std::ptrdiff_t>(heights.size() / 2);
  std::nth_element(heights.begin(), middle, heights.end());
  return *middle;
}

double shareAt(const std::vector<float>& heights, float level) {
  const auto near =
      std::count_if(heights.begin(), heights.end(), [&](float h) { return std::abs(h - level) < kMarginM; });
  return heights.empty() ? 0 : static_cast<double>(near) / static_cast<double>(heights.size());
}

Room roomOf(const Area& area, float heightM) {
  Room room;
  room.elevationM = area.elevationM;
  room.heightM = heightM;
  const MeterGrid& m = area.map;
  for (const Cell c : outlineOf(m)) {
    const Vec3 p =
        m.corner + m.u * (static_cast<float>(c.column) * m.stepUM) + m.v * (static_cast<float>(c.row) * m.stepVM);
    room.floor.push_back({p.x, p.z});
  }
  if (signedAreaM2(room.floor) < 0) std::reverse(room.floor.begin(), room.floor.end());
  return room;
}

// From the middle of a room: share of level rays that meet something, and of all that meet something how much turns its
// back.
struct Enclosure {
  double closed = 0, backs = 0;
};
Enclosure enclosureOf(const RayScene& rays, const Room& room) {
  constexpr int kRays = 128;
  const Vec2 middle = middleOf(room);
  const Vec3 eye{middle.x, room.elevationM + 0.6f * room.heightM, middle.y};
  int backs = 0, met = 0, level = 0, levelMet = 0;
  for (int i = 0; i < kRays; ++i) {
    const Vec3 d = sampleSphere(latticePoint(i, kRays));
    const Hit hit = rays.intersect({eye, d, 0, kInfinity});
    if (std::abs(d.y) < 0.4f) ++level, levelMet += hit.valid() ? 1 : 0;
    if (!hit.valid()) continue;
    ++met, backs += dot(hit.ng, d) > 0 ? 1 : 0;
  }
  return {levelMet / std::max(1.0, static_cast<double>(level)), backs / std::max(1.0, static_cast<double>(met))};
}

struct Candidate {
  Room room;
  double levelFloor = 0, levelCeiling = 0;  // shares
  Enclosure around{};
};

Candidate candidateOf(const RayScene& rays, const Area& area) {
  Heights heights = heightsIn(rays, area);
  const float ceiling = medianOf(heights.ceilings, kNoCeilingM);
  Candidate c{roomOf(area, ceiling), shareAt(heights.floors, 0), shareAt(heights.ceilings, ceiling)};
  c.around = enclosureOf(rays, c.room);
  return c;
}

// Between two plates is no room. A cave or a log is level nowhere. Where some rooms have faces, those that see little
// but backs are the insides of blocks; where all see backs, the file has its walls turned.
bool isRoom(const Candidate& c, bool othersHaveFaces) {
  constexpr double kLevel = 0.5, kSolid = 0.65, kClosed = 0.5;
  if (c.around.closed < kClosed) return false;
  if (c.around.backs > kSolid) return !othersHaveFaces && std::min(c.levelFloor, c.levelCeiling) > kLevel;
  return std::max(c.levelFloor, c.levelCeiling) > kLevel;
}

}  // namespace

std::vector<Room> findRooms(const RayScene& rays) {
  constexpr double kFaces = 0.5;
  std::vector<Candidate> candidates;
  for (const Area& area : findAreas(rays, kPlaneM, {0.2, 0, 0})) candidates.push_back(candidateOf(rays, area));
  const bool anyFaces =
      std::any_of(candidates.begin(), candidates.end(), [](const Candidate& c) { return c.around.backs < kFaces; });
  std::vector<Room> rooms;
  for (Candidate& c : candidates) {
    if (!isRoom(c, anyFaces)) continue;
    c.room.name = fmt::format("Room {}", rooms.size() + 1);
    rooms.push_back(std::move(c.room));
  }
  return rooms;
}

bool isIn(const Room& room, Vec3 p) {
  return p.y > room.elevationM - kMarginM && p.y < room.elevationM + room.heightM + kMarginM &&
         contains(room.floor, {p.x, p.z});
}

bool hasLight(const Scene& scene, const Room& room) {
  constexpr float kLeastCdM2 = 50;  // a display shines less
  if (std::any_of(scene.lamps.begin(), scene.lamps.end(), [&](const Lamp& l) { return isIn(room, l.position); }))
    return true;
  return std::any_of(scene.instances.begin(), scene.instances.end(), [&](const Instance& i) {
    const Material& m = scene.materials[static_cast<size_t>(scene.meshes[static_cast<size_t>(i.mesh)].material)];
    return luminance(m.emission) >= kLeastCdM2 && isIn(room, instanceBounds(scene, i).centre());
  });
}

double areaM2(const Room& room) { return std::abs(signedAreaM2(room.floor)); }

}  // namespace roomlight::home
