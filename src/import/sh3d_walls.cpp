#include "import/sh3d_plan.h"

#include <algorithm>
#include <cmath>

#include "import/sh3d_draft.h"
#include "import/sh3d_wall_parts.h"

namespace roomlight::importers::sh3d {
namespace {

constexpr double kTinyCm = 1e-3;

WallHeights heightsOf(const Home& home, const Wall& wall, const WallOutline& outline) {
  const double floor = elevationOf(home, wall.level);
  WallHeights h{floor - slabBelowCm(home, wall.level), floor, {}, {}};
  for (const PlanPoint& p : outline.left) h.leftTopCm.push_back(floor + wallHeightCm(home, wall, p));
  for (const PlanPoint& p : outline.right) h.rightTopCm.push_back(floor + wallHeightCm(home, wall, p));
  return h;
}

std::vector<Panel> panelsOf(const PlanRing& side, double baseCm, const std::vector<double>& topCm) {
  std::vector<Panel> out;
  for (size_t i = 0; i + 1 < side.size(); ++i) {
    if (std::hypot(side[i + 1].x - side[i].x, side[i + 1].y - side[i].y) < kTinyCm) continue;
    out.push_back({side[i], side[i + 1], baseCm, topCm[i], topCm[i + 1], false});
  }
  return out;
}

Vec3 horizontal(double x, double y) { return {static_cast<float>(x), 0, static_cast<float>(y)}; }

// What openings leave of one panel of a side or an end.
template <class Corner>
void addPanel(const Panel& p, const PlanArea& holes, int material, Vec3 front, const Corner& corner, Surfaces& out) {
  const PlanRing outline = p.outline();
  if (holes.empty()) {
    out.quad(material, {corner(outline[0]), corner(outline[1]), corner(outline[2]), corner(outline[3])}, front);
  } else {
    for (const PlanTriangle& t : out.cut(out.without({outline}, holes)))
      out.triangle(material, corner(t[0]), corner(t[1]), corner(t[2]), front);
  }
}

// One side of a wall: its panels without the holes. Texture coordinates run to the right as seen from that side, from
// the wall's base up.
void addSide(const std::vector<Panel>& panels, bool left, std::span<const WallCut> cuts, int material, Surfaces& out) {
  double whole = 0, before = 0;
  for (const Panel& p : panels) whole += p.lengthCm();
  for (const Panel& p : panels) {
    const double length = p.lengthCm(), sign = left ? 1 : -1;
    const Vec3 front = horizontal(sign * (p.b.y - p.a.y), -sign * (p.b.x - p.a.x));
    const auto corner = [&](PlanPoint q) {
      const double along = left ? whole - before - q.x : before + q.x;
      return SurfaceCorner{toWorld(p.at(q.x), q.y),
                           {static_cast<float>(along / 100), static_cast<float>((p.baseCm - q.y) / 100)}};
    };
    PlanArea holes;
    for (const WallCut& cut : cuts) out.unite(holes, cut.holeIn(p));
    addPanel(p, holes, material, front, corner, out);
    before += length;
  }
}

// Parameters from 0 to 1 at which the way from p to q passes a corner of the wall's sides.
std::vector<double> stopsOn(const WallCut& cut, PlanPoint p, PlanPoint q) {
  std::vector<double> stops{0, 1};
  for (const auto* side : {&cut.sides.left, &cut.sides.right}) {
    for (const Panel& panel : *side) {
      for (const PlanPoint& corner : {panel.a, panel.b}) {
        const double t = (cut.opening.u(corner) - p.x) / (q.x - p.x);
        if (t > 1e-6 && t < 1 - 1e-6) stops.push_back(t);
      }
    }
  }
  std::sort(stops.begin(), stops.end());
  return stops;
}

bool isLevelAt(PlanPoint p, PlanPoint q, double heightCm) {
  return std::abs(p.y - heightCm) < kTinyCm && std::abs(q.y - heightCm) < kTinyCm && std::abs(p.x - q.x) > kTinyCm;
}

PlanPoint between(PlanPoint p, PlanPoint q, double t) { return {p.x + (q.x - p.x) * t, p.y + (q.y - p.y) * t}; }

bool liesBetween(PlanPoint p, PlanPoint a, PlanPoint b) {
  return std::hypot(p.x - a.x, p.y - a.y) + std::hypot(p.x - b.x, p.y - b.y) <
         std::hypot(a.x - b.x, a.y - b.y) + kTinyCm;
}

// Where an upright border of the opening, or of a niche, lies in the wall's own end: that end has the hole.
bool isWallsEnd(const WallCut& cut, double u) {
  const PlanPoint l = cut.onLeft(u), r = cut.onRight(u);
  const Panel &first = cut.sides.left.front(), &last = cut.sides.left.back(), &s = cut.sides.right.front(),
              &e = cut.sides.right.back();
  return (liesBetween(l, first.a, s.a) && liesBetween(r, first.a, s.a)) ||
         (liesBetween(l, last.b, e.b) && liesBetween(r, last.b, e.b));
}

// The inside of an opening: its outline between the two sides, in pieces where a round side has a corner. No faces
// where the opening ends at the wall's base, as the floor goes on there, at its level top, or at its end.
void addReveals(const WallCut& cut, const WallHeights& heights, int material, Surfaces& out) {
  const Opening& o = cut.opening;
  for (const PlanRing& ring : o.shape) {
    for (size_t i = 0; i < ring.size(); ++i) {
      const PlanPoint p = ring[i], q = ring[(i + 1) % ring.size()];
      if (isLevelAt(p, q, heights.baseCm) || (heights.levelTop() && isLevelAt(p, q, heights.leftTopCm[0]))) continue;
      if (std::abs(p.x - q.x) < kTinyCm && isWallsEnd(cut, p.x)) continue;
      const std::vector<double> stops = stopsOn(cut, p, q);
      out.ask(2 * (stops.size() - 1)), out.spend(stops.size() * cut.panels() / 2);
      // Into the opening, which lies to the left of its outline.
      const Vec3 front{static_cast<float>((p.y - q.y) * o.along.x), static_cast<float>(q.x - p.x),
                       static_cast<float>((p.y - q.y) * o.along.y)};
      for (size_t k = 0; k + 1 < stops.size(); ++k) {
        const auto corner = [&](bool left, double t) {
          const PlanPoint at = between(p, q, t), on = left ? cut.onLeft(at.x) : cut.onRight(at.x);
          return SurfaceCorner{toWorld(on, at.y),
                               {static_cast<float>(o.v(on) / 100), static_cast<float>((at.x + at.y) / 100)}};
        };
        out.quad(
            material,
            {corner(true, stops[k]), corner(true, stops[k + 1]), corner(false, stops[k + 1]), corner(false, stops[k])},
            front);
      }
    }
  }
}

void addNicheBack(const WallCut& cut, int material, Surfaces& out) {
  if (cut.throughLeft && cut.throughRight) return;
  const auto corner = [&](PlanPoint p) {
    return SurfaceCorner{toWorld(cut.back(p.x), p.y), {static_cast<float>(p.x / 100), static_cast<float>(-p.y / 100)}};
  };
  const std::vector<PlanTriangle> triangles = out.cut(cut.opening.shape);
  out.spend(triangles.size() * cut.panels() / 8);
  for (const PlanTriangle& t : triangles) {
    const PlanPoint open = cut.throughLeft ? cut.onLeft(t[0].x) : cut.onRight(t[0].x), back = cut.back(t[0].x);
    out.triangle(material, corner(t[0]), corner(t[1]), corner(t[2]), horizontal(open.x - back.x, open.y - back.y));
  }
}

// On the plan, what openings take from the wall's bottom, or from its top where that is level.
PlanArea footprints(std::span<const WallCut> cuts, double heightCm, Surfaces& surfaces) {
  PlanArea out;
  for (const WallCut& cut : cuts) {
    for (const PlanRing& ring : cut.opening.shape) {
      for (size_t i = 0; i < ring.size(); ++i) {
        const PlanPoint p = ring[i], q = ring[(i + 1) % ring.size()];
        if (!isLevelAt(p, q, heightCm)) continue;
        const std::vector<double> stops = stopsOn(cut, p, q);
        surfaces.spend(stops.size() * cut.panels() / 4);
        PlanRing print;
        for (const double t : stops) print.push_back(cut.onLeft(between(p, q, t).x));
        for (size_t k = stops.size(); k-- > 0;) print.push_back(cut.onRight(between(p, q, stops[k]).x));
        surfaces.unite(out, united({print}, {}));
      }
    }
  }
  return out;
}

// Top or bottom of a wall.
struct Cover {
  const std::vector<double>&leftCm, &rightCm;  // heights at the corners of the sides, in a plane
  PlanArea holes;                              // what openings take, only of a level one
  int material = 0;
  Vec3 front;
};

// Between the sides, without what openings take.
void addCover(const WallOutline& outline, const Cover& cover, Surfaces& out) {
  const std::vector<double>&leftCm = cover.leftCm, &rightCm = cover.rightCm;
  const auto corner = [&](PlanPoint p, double height) {
    return SurfaceCorner{toWorld(p, height), {static_cast<float>(p.x / 100), static_cast<float>((p.y + height) / 100)}};
  };
  if (!cover.holes.empty()) {  // a level one
    for (const PlanTriangle& t : out.cut(out.without({outline.ring()}, cover.holes))) {
      out.triangle(cover.material, corner(t[0], leftCm[0]), corner(t[1], leftCm[0]), corner(t[2], leftCm[0]),
                   cover.front);
    }
    return;
  }
  for (size_t i = 0; i + 1 < outline.left.size(); ++i) {
    out.quad(cover.material,
             {corner(outline.left[i], leftCm[i]), corner(outline.left[i + 1], leftCm[i + 1]),
              corner(outline.right[i + 1], rightCm[i + 1]), corner(outline.right[i], rightCm[i])},
             cover.front);
  }
}

// Top, bottom and the two ends.
void addRest(const WallOutline& outline, const WallHeights& h, std::span<const WallCut> cuts, int top, int rest,
             Surfaces& out) {
  const std::vector<double> base(outline.left.size(), h.baseCm);
  addCover(
      outline,
      {h.leftTopCm, h.rightTopCm, h.levelTop() ? footprints(cuts, h.leftTopCm[0], out) : PlanArea(), top, {0, 1, 0}},
      out);
  addCover(outline, {base, base, footprints(cuts, h.baseCm, out), rest, {0, -1, 0}}, out);
  const size_t last = outline.left.size() - 1;
  for (const size_t i : {size_t{0}, last}) {
    const size_t inner = i == 0 ? 1 : last - 1;
    const Panel end{outline.left[i], outline.right[i], h.baseCm, h.leftTopCm[i], h.rightTopCm[i], true};
    if (end.lengthCm() < kTinyCm) continue;
    const Vec3 front =
        horizontal(outline.left[i].x - outline.left[inner].x + outline.right[i].x - outline.right[inner].x,
                   outline.left[i].y - outline.left[inner].y + outline.right[i].y - outline.right[inner].y);
    PlanArea holes;
    for (const WallCut& cut : cuts) out.unite(holes, cut.holeInEnd(end));
    addPanel(
        end, holes, rest, front,
        [&](PlanPoint q) {
          return SurfaceCorner{toWorld(end.at(q.x), q.y),
                               {static_cast<float>(q.x / 100), static_cast<float>(-q.y / 100)}};
        },
        out);
  }
}

// Those that may touch a wall.
std::vector<Opening> openingsAt(const WallOutline& outline, const std::vector<Opening>& openings,
                                const std::string& place, Effort& effort) {
  PlanPoint lo{1e300, 1e300}, hi{-1e300, -1e300};
  for (const PlanPoint& p : outline.ring())
    lo = {std::min(lo.x, p.x), std::min(lo.y, p.y)}, hi = {std::max(hi.x, p.x), std::max(hi.y, p.y)};
  std::vector<Opening> out;
  effort.spend(openings.size() / 16, place);
  for (const Opening& o : openings) {
    const double r = o.radiusCm + 2;
    if (o.centre.x + r < lo.x || o.centre.x - r > hi.x || o.centre.y + r < lo.y || o.centre.y - r > hi.y) continue;
    out.push_back(o);
    effort.spend(outline.left.size() * o.points * out.size(), place);
  }
  return out;
}

// Before outlines are made: what the walls themselves come to, with no opening cut.
void askForAll(const Home& home, const std::vector<WallOffsets>& boards, const Effort& effort) {
  constexpr size_t kAChord = 8, kEnds = 4, kABoardsChord = 12;
  size_t all = 0;
  for (size_t i = 0; i < home.walls.size(); ++i) {
    const Wall& w = home.walls[i];
    if (!isShown(home, w.level)) continue;
    const size_t ofBody = chordsOf(w, {w.thicknessCm / 2, w.thicknessCm / 2}), ofBoards = chordsOf(w, boards[i]);
    const size_t triangles =
        kAChord * ofBody + kEnds + kABoardsChord * ofBoards * ((w.leftBaseboard ? 1 : 0) + (w.rightBaseboard ? 1 : 0));
    effort.ask(triangles, w.place, all);
    all += triangles;
  }
}

// What is known of all walls before the first is drawn.
struct Plan {
  const Home& home;
  std::vector<WallOutline> outlines, boards;
  std::vector<Opening> openings;
  std::vector<std::string> labels;
};

void addWall(const Plan& plan, size_t i, Paints& paints, Draft& draft) {
  const Wall& w = plan.home.walls[i];
  const WallOutline& outline = plan.outlines[i];
  const WallHeights h = heightsOf(plan.home, w, outline);
  const std::vector<Panel> leftSide = panelsOf(outline.left, h.baseCm, h.leftTopCm),
                           rightSide = panelsOf(outline.right, h.baseCm, h.rightTopCm);
  const WallSides sides{leftSide, rightSide, leftSide.size() == 1 && rightSide.size() == 1};
  std::vector<WallCut> cuts;
  if (!sides.left.empty() && !sides.right.empty())
    cuts = cutsOf(sides, openingsAt(outline, plan.openings, w.place, draft.effort), draft.effort, w.place);
  Paint top;
  top.colour = w.topColour ? w.topColour : w.left.colour;
  Surfaces surfaces(draft.effort, w.place);
  const int left = paints.material(w.left, "wall"), plain = paints.plain(w.left, "wall");
  addSide(leftSide, true, cuts, left, surfaces);
  addSide(rightSide, false, cuts, paints.material(w.right, "wall"), surfaces);
  addRest(outline, h, cuts, paints.plain(top, "wall top"), plain, surfaces);
  for (const WallCut& cut : cuts) addReveals(cut, h, plain, surfaces), addNicheBack(cut, plain, surfaces);
  addBaseboards({w, outline, h, cuts}, plan.boards[i], paints, surfaces);
  surfaces.finish(draft, w.id.empty() ? "wall" : w.id, plan.labels[i]);
  ++draft.object;
}

}  // namespace

void addWalls(const Home& home, Paints& paints, Draft& draft) {
  const std::vector<WallOffsets> boards = baseboardOffsets(home);
  askForAll(home, boards, draft.effort);
  Plan plan{home, wallOutlines(home), wallOutlines(home, boards), openingsOf(home, draft.effort, draft.warnings), {}};
  plan.labels = wallLabels(home, plan.outlines);
  for (size_t i = 0; i < home.walls.size(); ++i) {
    if (!isShown(home, home.walls[i].level)) continue;
    if (plan.outlines[i].left.empty()) {
      draft.warnings.mended("walls without length are left out");
    } else {
      addWall(plan, i, paints, draft);
    }
  }
}

}  // namespace roomlight::importers::sh3d
