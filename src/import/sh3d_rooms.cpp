#include "import/sh3d_plan.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "import/sh3d_draft.h"
#include "import/sh3d_wall_parts.h"

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
  PlanArea outline;
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

// The hole of stairs on the plan, and the heights that they rise through.
struct Stairs {
  PlanArea hole;
  double bottomCm = 0, topCm = 0;
};

std::vector<Stairs> stairsOf(const Home& home, Draft& draft) {
  std::vector<Stairs> out;
  for (const Piece& p : home.pieces) {
    if (p.staircaseCutOutShape.empty() || !isShown(home, p.level)) continue;
    PlanArea shape = svgPath(p.staircaseCutOutShape);
    if (!draft.effort.untangles(shape, p.place)) {
      draft.warnings.add(fmt::format("holes of stairs that cross themselves more than {} times are left out",
                                     Effort::kMostOwnCrossings));
      continue;
    }
    const double c = std::cos(p.angleRad), s = std::sin(p.angleRad);
    for (PlanRing& ring : shape) {
      for (PlanPoint& q : ring) {
        const double x = ((p.mirrored ? 1 - q.x : q.x) - 0.5) * p.widthCm, y = (q.y - 0.5) * p.depthCm;
        q = {p.centre.x + x * c - y * s, p.centre.y + x * s + y * c};
      }
    }
    const double bottom = elevationOf(home, p.level) + p.elevationCm;
    out.push_back({united(shape, {}), bottom, bottom + p.heightCm});
  }
  return out;
}

// All holes at one height: in floors that stairs rise through, in ceilings that they rise above.
PlanArea stairwells(const std::vector<Stairs>& stairs, double heightCm, Surfaces& surfaces) {
  PlanArea out;
  surfaces.spend(stairs.size() / 16);
  for (const Stairs& s : stairs) {
    if (s.bottomCm < heightCm - kSameHeightCm && s.topCm >= heightCm - kSameHeightCm) surfaces.unite(out, s.hole);
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

void addFace(const PlanArea& area, const Drawn& drawn, bool ceiling, int material, Surfaces& out) {
  const auto corner = [&](PlanPoint p) {
    return SurfaceCorner{toWorld(p, ceiling ? ceilingOn(area, drawn, p) : drawn.floorCm),
                         {static_cast<float>(p.x / 100), static_cast<float>(p.y / 100)}};
  };
  const std::vector<PlanTriangle> triangles = out.cut(area);
  size_t points = 0;
  for (const PlanRing& ring : area) points += ring.size();
  out.spend(triangles.size() * (ceiling && !drawn.flat ? 1 + (points * (1 + drawn.corners->size())) / 8 : 1));
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
    out.ask(2 * ring.size());
    for (size_t i = 0; i < ring.size(); ++i) {
      const PlanPoint p = ring[i], q = ring[(i + 1) % ring.size()];
      const double length = std::hypot(q.x - p.x, q.y - p.y);
      const Vec3 front{static_cast<float>(q.y - p.y), 0,
                       static_cast<float>(p.x - q.x)};  // rings have their inside at the left
      out.quad(material, {corner(p, 0, bottom), corner(q, length, bottom), corner(q, length, top), corner(p, 0, top)},
               front);
    }
  }
  for (const PlanTriangle& t : out.cut(underside)) {
    out.triangle(material, corner(t[0], t[0].x, bottom), corner(t[1], t[1].x, bottom), corner(t[2], t[2].x, bottom),
                 {0, -1, 0});
  }
}

// The room without those of the same height that the file names later.
PlanArea visibleArea(const std::vector<Drawn>& all, size_t i, bool ceiling, Surfaces& surfaces) {
  PlanArea area = all[i].outline;
  surfaces.spend(all.size() / 16);
  for (size_t k = i + 1; k < all.size(); ++k) {
    const Room& other = *all[k].room;
    if (!all[i].overlaps(all[k]) || !(ceiling ? other.ceilingVisible : other.floorVisible)) continue;
    const double here = ceiling ? all[i].ceilingCm : all[i].floorCm,
                 there = ceiling ? all[k].ceilingCm : all[k].floorCm;
    if (std::abs(here - there) < kSameHeightCm) area = surfaces.without(area, all[k].outline);
  }
  return area;
}

// Of a floor the part whose slab, `bottomCm` high from below, no ceiling of a lower room closes. Ceilings that stairs
// leave by are open there.
PlanArea undersideOf(const PlanArea& floor, const std::vector<Drawn>& all, size_t i, double bottomCm,
                     const PlanArea& stairwells, Surfaces& surfaces) {
  PlanArea area = floor;
  surfaces.spend(all.size() / 16);
  for (const Drawn& lower : all) {
    if (!lower.room->ceilingVisible || !lower.flat || std::abs(lower.ceilingCm - bottomCm) >= kSameHeightCm ||
        !lower.overlaps(all[i]))
      continue;
    area = surfaces.without(area, stairwells.empty() ? lower.outline : surfaces.without(lower.outline, stairwells));
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

std::vector<Drawn> drawnRooms(const Home& home, std::map<int, std::vector<WallCorner>>& corners, Draft& draft) {
  const std::vector<WallOutline> outlines = wallOutlines(home);
  std::vector<Drawn> all;
  Listed tangles;
  for (const Room& room : home.rooms) {
    if (!isShown(home, room.level)) continue;
    if (room.points.size() < 3 || std::abs(signedAreaOf(room.points)) < 1) {
      draft.warnings.mended("rooms without area are left out");
      continue;
    }
    std::optional<PlanArea> outline = outlineOf(room, draft.effort);
    if (!outline) {
      tangles.add(room.place);
      continue;
    }
    const auto [entry, isNew] = corners.try_emplace(room.level);
    if (isNew) entry->second = wallCorners(home, room.level, outlines);
    all.push_back({&room,
                   std::move(*outline),
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
  tangles.addTo(draft.warnings, fmt::format("rooms whose outline crosses itself more than {} times are left out: ",
                                            Effort::kMostOwnCrossings));
  return all;
}

void addRoom(const std::vector<Drawn>& all, size_t i, double bottomCm, const std::vector<Stairs>& stairs,
             Paints& paints, Draft& draft) {
  const Drawn& drawn = all[i];
  const Room& room = *drawn.room;
  Surfaces surfaces(draft.effort, room.place);
  if (room.floorVisible) {
    const PlanArea area =
        surfaces.without(visibleArea(all, i, false, surfaces), stairwells(stairs, drawn.floorCm, surfaces));
    addFace(area, drawn, false, paints.material(room.floor, "floor"), surfaces);
    if (bottomCm <= drawn.floorCm - kSameHeightCm) {
      const PlanArea underside = undersideOf(area, all, i, bottomCm, stairwells(stairs, bottomCm, surfaces), surfaces);
      addSlab(area, underside, drawn.floorCm, bottomCm, paints.plain(room.floor, "floor"), surfaces);
    }
  }
  if (room.ceilingVisible) {
    const PlanArea area =
        surfaces.without(visibleArea(all, i, true, surfaces), stairwells(stairs, drawn.ceilingCm, surfaces));
    addFace(area, drawn, true, paints.material(room.ceiling, "ceiling"), surfaces);
  }
  surfaces.finish(draft, room.name.empty() ? "room" : room.name);
  ++draft.object;
}

}  // namespace

std::optional<PlanArea> outlineOf(const Room& room, Effort& effort) {
  const PlanArea drawn{room.points};
  return effort.untangles(drawn, room.place) ? std::optional(united(drawn, {})) : std::nullopt;
}

void addRooms(const Home& home, Paints& paints, Draft& draft) {
  std::map<int, std::vector<WallCorner>> corners;
  const std::vector<Drawn> all = drawnRooms(home, corners, draft);
  const std::vector<Stairs> stairs = stairsOf(home, draft);
  for (size_t i = 0; i < all.size(); ++i) {
    addToScene(all[i], draft.effort, draft.scene);
    addRoom(all, i, all[i].floorCm - slabBelowCm(home, all[i].room->level), stairs, paints, draft);
  }
}

}  // namespace roomlight::importers::sh3d
