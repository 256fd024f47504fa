#include "import/sh3d_walls.h"

#include <algorithm>
#include <cmath>

#include "import/sh3d_baseboards.h"
#include "import/sh3d_openings.h"
#include "import/sh3d_surfaces.h"
#include "import/sh3d_wall_cut.h"
#include "import/sh3d_wall_outline.h"

namespace roomlight::importers::sh3d {
namespace {

constexpr double kTinyCm = 1e-3;

WallHeights heightsOf(const Home& home, const Wall& wall, size_t corners) {
  const double floor = elevationOf(home, wall.level);
  WallHeights h{floor - slabBelowCm(home, wall.level), floor, {}};
  for (size_t i = 0; i < corners; ++i) h.topCm.push_back(floor + wallHeightCm(home, wall, i, corners));
  return h;
}

std::vector<Panel> panelsOf(const PlanRing& side, const WallHeights& h) {
  std::vector<Panel> out;
  for (size_t i = 0; i + 1 < side.size(); ++i) {
    if (std::hypot(side[i + 1].x - side[i].x, side[i + 1].y - side[i].y) < kTinyCm) continue;
    out.push_back({side[i], side[i + 1], h.baseCm, h.topCm[i], h.topCm[i + 1]});
  }
  return out;
}

Vec3 horizontal(double x, double y) { return {static_cast<float>(x), 0, static_cast<float>(y)}; }

// One side of a wall: its panels without the holes. Texture coordinates run to the right as seen from that side, from the wall's base up.
void addSide(const std::vector<Panel>& panels, bool left, std::span<const WallCut> cuts, int material, Surfaces& out) {
  double whole = 0, before = 0;
  for (const Panel& p : panels) whole += p.lengthCm();
  for (const Panel& p : panels) {
    const double length = p.lengthCm(), sign = left ? 1 : -1;
    const Vec3 front = horizontal(sign * (p.b.y - p.a.y), -sign * (p.b.x - p.a.x));
    const auto corner = [&](PlanPoint q) {
      const double t = q.x / length, along = left ? whole - before - q.x : before + q.x;
      return SurfaceCorner{toWorld({p.a.x + (p.b.x - p.a.x) * t, p.a.y + (p.b.y - p.a.y) * t}, q.y),
                           {static_cast<float>(along / 100), static_cast<float>((p.baseCm - q.y) / 100)}};
    };
    PlanArea holes;
    for (const WallCut& cut : cuts) {
      const PlanArea hole = cut.holeIn(p);
      if (!hole.empty()) holes = holes.empty() ? hole : united(holes, hole);
    }
    const PlanRing outline = p.outline();
    if (holes.empty()) {
      out.quad(material, {corner(outline[0]), corner(outline[1]), corner(outline[2]), corner(outline[3])}, front);
    } else {
      for (const PlanTriangle& t : trianglesOf(subtracted({outline}, holes))) out.triangle(material, corner(t[0]), corner(t[1]), corner(t[2]), front);
    }
    before += length;
  }
}

// The inside of an opening: its outline between the two sides, in pieces where a round side has a corner. No faces where the opening ends at
// the wall's base, as the floor goes on there, or at its top.
void addReveals(const WallCut& cut, int material, Surfaces& out) {
  const Opening& o = cut.opening;
  const WallSides& sides = *cut.sides;
  std::vector<double> corners;
  for (const auto* side : {&sides.left, &sides.right}) {
    for (const Panel& p : *side) corners.push_back(o.u(p.a)), corners.push_back(o.u(p.b));
  }
  const double baseCm = sides.left.front().baseCm;
  for (const PlanRing& ring : o.shape) {
    for (size_t i = 0; i < ring.size(); ++i) {
      const PlanPoint p = ring[i], q = ring[(i + 1) % ring.size()];
      if (std::max(p.y, q.y) < baseCm + kTinyCm) continue;
      std::vector<double> stops{0, 1};
      for (const double u : corners) {
        const double t = (u - p.x) / (q.x - p.x);
        if (t > 1e-6 && t < 1 - 1e-6) stops.push_back(t);
      }
      std::sort(stops.begin(), stops.end());
      // Into the opening, which lies to the left of its outline.
      const Vec3 front{static_cast<float>((p.y - q.y) * o.along.x), static_cast<float>(q.x - p.x), static_cast<float>((p.y - q.y) * o.along.y)};
      for (size_t k = 0; k + 1 < stops.size(); ++k) {
        const auto corner = [&](bool left, double t) {
          const PlanPoint at{p.x + (q.x - p.x) * t, p.y + (q.y - p.y) * t}, on = left ? cut.onLeft(at.x) : cut.onRight(at.x);
          return SurfaceCorner{toWorld(on, at.y), {static_cast<float>(o.v(on) / 100), static_cast<float>((at.x + at.y) / 100)}};
        };
        out.quad(material, {corner(true, stops[k]), corner(true, stops[k + 1]), corner(false, stops[k + 1]), corner(false, stops[k])}, front);
      }
    }
  }
}

void addNicheBack(const WallCut& cut, int material, Surfaces& out) {
  if (cut.throughLeft && cut.throughRight) return;
  const auto corner = [&](PlanPoint p) { return SurfaceCorner{toWorld(cut.back(p.x), p.y), {static_cast<float>(p.x / 100), static_cast<float>(-p.y / 100)}}; };
  for (const PlanTriangle& t : trianglesOf(cut.opening.shape)) {
    const PlanPoint open = cut.throughLeft ? cut.onLeft(t[0].x) : cut.onRight(t[0].x), back = cut.back(t[0].x);
    out.triangle(material, corner(t[0]), corner(t[1]), corner(t[2]), horizontal(open.x - back.x, open.y - back.y));
  }
}

// Top and bottom between the sides, and the two ends.
void addRest(const WallOutline& outline, const WallHeights& h, int top, int rest, Surfaces& out) {
  const auto corner = [&](const PlanRing& side, size_t i, double height) {
    return SurfaceCorner{toWorld(side[i], height), {static_cast<float>(side[i].x / 100), static_cast<float>((side[i].y + height) / 100)}};
  };
  const size_t last = outline.left.size() - 1;
  for (size_t i = 0; i < last; ++i) {
    const auto cover = [&](double first, double second, int material, Vec3 front) {
      out.quad(material, {corner(outline.left, i, first), corner(outline.left, i + 1, second), corner(outline.right, i + 1, second), corner(outline.right, i, first)}, front);
    };
    cover(h.topCm[i], h.topCm[i + 1], top, {0, 1, 0});
    cover(h.baseCm, h.baseCm, rest, {0, -1, 0});
  }
  for (const size_t i : {size_t{0}, last}) {
    const size_t inner = i == 0 ? 1 : last - 1;
    const Vec3 front = horizontal(outline.left[i].x - outline.left[inner].x + outline.right[i].x - outline.right[inner].x,
                                  outline.left[i].y - outline.left[inner].y + outline.right[i].y - outline.right[inner].y);
    out.quad(rest, {corner(outline.left, i, h.baseCm), corner(outline.right, i, h.baseCm), corner(outline.right, i, h.topCm[i]), corner(outline.left, i, h.topCm[i])}, front);
  }
}

// Those that may touch a wall.
std::vector<Opening> openingsAt(const WallOutline& outline, const std::vector<Opening>& openings, const std::string& place, Effort& effort) {
  PlanPoint lo{1e300, 1e300}, hi{-1e300, -1e300};
  for (const PlanPoint& p : outline.ring()) lo = {std::min(lo.x, p.x), std::min(lo.y, p.y)}, hi = {std::max(hi.x, p.x), std::max(hi.y, p.y)};
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

}  // namespace

void addWalls(const Home& home, Paints& paints, Scene& scene, int& object, Effort& effort, Warnings& warnings) {
  const std::vector<WallOutline> outlines = wallOutlines(home);
  const std::vector<WallOutline> boards = wallOutlines(home, baseboardOffsets(home));
  const std::vector<Opening> openings = openingsOf(home, warnings);
  for (size_t i = 0; i < home.walls.size(); ++i) {
    const Wall& w = home.walls[i];
    if (!isShown(home, w.level)) continue;
    if (outlines[i].left.empty()) {
      warnings.add("walls without length are left out");
      continue;
    }
    const WallHeights h = heightsOf(home, w, outlines[i].left.size());
    const WallSides sides{panelsOf(outlines[i].left, h), panelsOf(outlines[i].right, h)};
    std::vector<WallCut> cuts;
    if (!sides.left.empty() && !sides.right.empty()) cuts = cutsOf(sides, openingsAt(outlines[i], openings, w.place, effort));
    Paint top;
    top.colour = w.topColour ? w.topColour : w.left.colour;
    Surfaces surfaces;
    const int left = paints.material(w.left, "wall"), plain = paints.plain(w.left, "wall");
    addSide(sides.left, true, cuts, left, surfaces);
    addSide(sides.right, false, cuts, paints.material(w.right, "wall"), surfaces);
    addRest(outlines[i], h, paints.plain(top, "wall top"), plain, surfaces);
    for (const WallCut& cut : cuts) addReveals(cut, plain, surfaces), addNicheBack(cut, plain, surfaces);
    addBaseboards(w, outlines[i], boards[i], h, cuts, paints, surfaces);
    surfaces.finish(scene, w.id.empty() ? "wall" : w.id, object++);
  }
}

}  // namespace roomlight::importers::sh3d
