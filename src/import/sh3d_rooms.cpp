#include "import/sh3d_rooms.h"

#include <algorithm>
#include <cmath>

#include "import/sh3d_openings.h"
#include "import/sh3d_surfaces.h"
#include "import/sh3d_wall_outline.h"

namespace roomlight::importers::sh3d {
namespace {

constexpr double kSameHeightCm = 1e-3;

bool isHighest(const Home& home, int level) {
  if (level < 0) return true;
  const double own = elevationOf(home, level);
  return std::none_of(home.levels.begin(), home.levels.end(),
                      [&](const Level& l) { return l.viewable && l.elevationCm > own + kSameHeightCm; });
}

double levelTopCm(const Home& home, int level) {
  return level < 0
             ? home.wallHeightCm
             : home.levels[static_cast<size_t>(level)].elevationCm + home.levels[static_cast<size_t>(level)].heightCm;
}

// A corner of a wall on the plan and how high the wall is there.
struct WallCorner {
  PlanPoint at;
  double topCm = 0;
};

std::vector<WallCorner> wallCorners(const Home& home, int level, const std::vector<WallOutline>& outlines) {
  std::vector<WallCorner> out;
  for (size_t i = 0; i < home.walls.size(); ++i) {
    const Wall& w = home.walls[i];
    if (w.level != level) continue;
    for (const PlanRing* side : {&outlines[i].left, &outlines[i].right}) {
      for (size_t k = 0; k < side->size(); ++k)
        out.push_back({(*side)[k], elevationOf(home, level) + wallHeightCm(home, w, (*side)[k])});
    }
  }
  return out;
}

// What every part of the work needs of a room.
struct Drawn {
  const Room* room = nullptr;
  double floorCm = 0;
  bool flat = true;
  double ceilingCm = 0;                    // of a flat one
  std::vector<WallCorner> const* corners = nullptr;
  PlanPoint lo, hi;                        // around it

  bool overlaps(const Drawn& o) const { return lo.x < o.hi.x && o.lo.x < hi.x && lo.y < o.hi.y && o.lo.y < hi.y; }

  // Height of the ceiling: the top of the wall whose corner is nearest.
  double ceilingAt(PlanPoint p) const {
    if (flat || corners->empty()) return ceilingCm;
    double nearest = 1e300, top = ceilingCm;
    for (const WallCorner& c : *corners) {
      const double d = (c.at.x - p.x) * (c.at.x - p.x) + (c.at.y - p.y) * (c.at.y - p.y);
      if (d < nearest) nearest = d, top = c.topCm;
    }
    return top;
  }
};

// The stairs' holes on the plan: through floors that they rise through, through ceilings that they rise above.
PlanArea stairwells(const Home& home, const std::vector<const Piece*>& stairs, double heightCm,
                    const std::string& place, Effort& effort) {
  PlanArea out;
  size_t points = 0;
  for (const Piece* piece : stairs) {
    const Piece& p = *piece;
    const double bottom = elevationOf(home, p.level) + p.elevationCm, top = bottom + p.heightCm;
    if (!(bottom < heightCm - kSameHeightCm && top >= heightCm - kSameHeightCm)) continue;
    PlanArea shape = svgPath(p.staircaseCutOutShape);
    const double c = std::cos(p.angleRad), s = std::sin(p.angleRad);
    for (PlanRing& ring : shape) {
      for (PlanPoint& q : ring) {
        const double x = ((p.mirrored ? 1 - q.x : q.x) - 0.5) * p.widthCm, y = (q.y - 0.5) * p.depthCm;
        q = {p.centre.x + x * c - y * s, p.centre.y + x * s + y * c};
      }
    }
    for (const PlanRing& ring : shape) points += ring.size();
    effort.spend(points * 8, place);
    out = united(out, shape);
  }
  return out;
}

// Heights of a ceiling: those of its outline's corners, straight lines in between. Triangles have all their corners on
// the outline.
double ceilingOn(const PlanArea& area, const Drawn& drawn, PlanPoint p) {
  if (drawn.flat) return drawn.ceilingCm;
  double nearest = 1e300, height = drawn.ceilingCm;
  for (const PlanRing& ring : area) {
    for (size_t i = 0; i < ring.size(); ++i) {
      const PlanPoint a = ring[i], b = ring[(i + 1) % ring.size()];
      const double x = b.x - a.x, y = b.y - a.y, squared = x * x + y * y;
      const double t = squared > 0 ? std::clamp(((p.x - a.x) * x + (p.y - a.y) * y) / squared, 0.0, 1.0) : 0;
      const double away = std::hypot(a.x + x * t - p.x, a.y + y * t - p.y);
      if (away >= nearest) continue;
      nearest = away;
      height = t == 0   ? drawn.ceilingAt(a)
               : t == 1 ? drawn.ceilingAt(b)
                        : drawn.ceilingAt(a) + (drawn.ceilingAt(b) - drawn.ceilingAt(a)) * t;
    }
  }
  return height;
}

void addFace(const PlanArea& area, const Drawn& drawn, bool ceiling, int material, Effort& effort, Surfaces& out) {
  const auto corner = [&](PlanPoint p) {
    return SurfaceCorner{toWorld(p, ceiling ? ceilingOn(area, drawn, p) : drawn.floorCm),
                         {static_cast<float>(p.x / 100), static_cast<float>(p.y / 100)}};
  };
  const std::vector<PlanTriangle> triangles = trianglesOf(area);
  size_t points = 0;
  for (const PlanRing& ring : area) points += ring.size();
  effort.spend(triangles.size() * (ceiling && !drawn.flat ? 1 + (points * (1 + drawn.corners->size())) / 8 : 1),
               drawn.room->place);
  for (const PlanTriangle& t : triangles)
    out.triangle(material, corner(t[0]), corner(t[1]), corner(t[2]), {0, ceiling ? -1.0f : 1.0f, 0});
}

// What is seen of the slab under a floor of an upper level: its edges, in stairwells too, and its underside where no
// ceiling closes it.
void addSlab(const PlanArea& area, const PlanArea& underside, double top, double bottom, int material, Surfaces& out) {
  const auto corner = [](PlanPoint p, double s, double h) {
    return SurfaceCorner{toWorld(p, h), {static_cast<float>(s / 100), static_cast<float>(-h / 100)}};
  };
  for (const PlanRing& ring : area) {
    for (size_t i = 0; i < ring.size(); ++i) {
      const PlanPoint p = ring[i], q = ring[(i + 1) % ring.size()];
      const double length = std::hypot(q.x - p.x, q.y - p.y);
      const Vec3 front{static_cast<float>(q.y - p.y), 0,
                       static_cast<float>(p.x - q.x)};  // rings have their inside at the left
      out.quad(material, {corner(p, 0, bottom), corner(q, length, bottom), corner(q, length, top), corner(p, 0, top)},
               front);
    }
  }
  for (const PlanTriangle& t : trianglesOf(underside)) {
    out.triangle(material, corner(t[0], t[0].x, bottom), corner(t[1], t[1].x, bottom), corner(t[2], t[2].x, bottom),
                 {0, -1, 0});
  }
}

// The room without those of the same height that the file names later.
PlanArea visibleArea(const std::vector<Drawn>& all, size_t i, bool ceiling, Effort& effort) {
  PlanArea area = united({all[i].room->points}, {});
  effort.spend(all.size() / 16, all[i].room->place);
  for (size_t k = i + 1; k < all.size(); ++k) {
    const Room& other = *all[k].room;
    if (!all[i].overlaps(all[k]) || !(ceiling ? other.ceilingVisible : other.floorVisible)) continue;
    const double here = ceiling ? all[i].ceilingCm : all[i].floorCm,
                 there = ceiling ? all[k].ceilingCm : all[k].floorCm;
    if (std::abs(here - there) >= kSameHeightCm) continue;
    for (const PlanRing& ring : area) effort.spend(8 * ring.size(), all[i].room->place);
    effort.spend(8 * other.points.size(), all[i].room->place);
    area = subtracted(area, {other.points});
  }
  return area;
}

// Of a floor the part whose slab, `bottomCm` high from below, no ceiling of a lower room closes. Ceilings that stairs
// leave by are open there.
PlanArea undersideOf(const PlanArea& floor, const std::vector<Drawn>& all, size_t i, double bottomCm,
                     const PlanArea& stairwells, Effort& effort) {
  PlanArea area = floor;
  const std::string& place = all[i].room->place;
  effort.spend(all.size() / 16, place);
  for (const Drawn& lower : all) {
    if (!lower.room->ceilingVisible || !lower.flat || std::abs(lower.ceilingCm - bottomCm) >= kSameHeightCm ||
        !lower.overlaps(all[i]))
      continue;
    for (const PlanRing& ring : area) effort.spend(8 * ring.size(), place);
    effort.spend(8 * lower.room->points.size(), place);
    const PlanArea ceiling = united({lower.room->points}, {});
    area = subtracted(area, stairwells.empty() ? ceiling : subtracted(ceiling, stairwells));
  }
  return area;
}

// Counter-clockwise seen from above: z points towards the reader of the plan, as its y does.
void addToScene(const Drawn& drawn, Effort& effort, Scene& scene) {
  roomlight::Room room;
  room.name = drawn.room->name.empty() ? "room" : drawn.room->name;
  PlanRing ring = drawn.room->points;
  if (signedAreaOf(ring) > 0) std::reverse(ring.begin(), ring.end());
  double height = 0;
  effort.spend(ring.size() * (1 + drawn.corners->size() / 8), drawn.room->place);
  for (const PlanPoint& p : ring) {
    room.floor.push_back({static_cast<float>(p.x / 100), static_cast<float>(p.y / 100)});
    height = std::max(height, drawn.ceilingAt(p) - drawn.floorCm);
  }
  room.elevationM = static_cast<float>(drawn.floorCm / 100);
  room.heightM = static_cast<float>(height / 100);
  scene.rooms.push_back(std::move(room));
}

}  // namespace

void addRooms(const Home& home, Paints& paints, Scene& scene, int& object, Effort& effort, Warnings& warnings) {
  const std::vector<WallOutline> outlines = wallOutlines(home);
  std::map<int, std::vector<WallCorner>> corners;
  std::vector<Drawn> all;
  for (const Room& room : home.rooms) {
    if (!isShown(home, room.level)) continue;
    if (room.points.size() < 3 || std::abs(signedAreaOf(room.points)) < 1) {
      warnings.mended("rooms without area are left out");
      continue;
    }
    const auto [entry, isNew] = corners.try_emplace(room.level);
    if (isNew) entry->second = wallCorners(home, room.level, outlines);
    all.push_back({&room,
                   elevationOf(home, room.level),
                   room.ceilingFlat || !isHighest(home, room.level),
                   levelTopCm(home, room.level),
                   &entry->second,
                   {},
                   {}});
    Drawn& drawn = all.back();
    drawn.lo = drawn.hi = room.points.front();
    for (const PlanPoint& p : room.points) {
      drawn.lo = {std::min(drawn.lo.x, p.x), std::min(drawn.lo.y, p.y)},
      drawn.hi = {std::max(drawn.hi.x, p.x), std::max(drawn.hi.y, p.y)};
    }
  }
  std::vector<const Piece*> stairs;
  for (const Piece& p : home.pieces) {
    if (!p.staircaseCutOutShape.empty() && isShown(home, p.level)) stairs.push_back(&p);
  }
  for (size_t i = 0; i < all.size(); ++i) {
    const Room& room = *all[i].room;
    const std::string name = room.name.empty() ? "room" : room.name;
    addToScene(all[i], effort, scene);
    Surfaces surfaces;
    if (room.floorVisible) {
      const PlanArea area =
          subtracted(visibleArea(all, i, false, effort), stairwells(home, stairs, all[i].floorCm, room.place, effort));
      addFace(area, all[i], false, paints.material(room.floor, "floor"), effort, surfaces);
      const double top = all[i].floorCm, bottom = top - slabBelowCm(home, room.level);
      if (bottom <= top - kSameHeightCm) {
        const PlanArea underside =
            undersideOf(area, all, i, bottom, stairwells(home, stairs, bottom, room.place, effort), effort);
        addSlab(area, underside, top, bottom, paints.plain(room.floor, "floor"), surfaces);
      }
    }
    if (room.ceilingVisible) {
      const PlanArea area =
          subtracted(visibleArea(all, i, true, effort), stairwells(home, stairs, all[i].ceilingCm, room.place, effort));
      addFace(area, all[i], true, paints.material(room.ceiling, "ceiling"), effort, surfaces);
    }
    surfaces.finish(scene, name, object++);
  }
}

}  // namespace roomlight::importers::sh3d
