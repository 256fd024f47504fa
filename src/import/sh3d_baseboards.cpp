#include "import/sh3d_wall_parts.h"

#include <algorithm>
#include <cmath>

namespace roomlight::importers::sh3d {
namespace {

constexpr double kTinyCm = 1e-3;

struct Interval {
  double from = 0, to = 0;
};

// Of [0, length]: what openings leave of a panel at its height.
std::vector<Interval> left(const Panel& panel, double thicknessCm, std::span<const WallCut> cuts) {
  std::vector<Interval> out{{0, panel.lengthCm()}};
  for (WallCut cut : cuts) {
    cut.opening.vLow -= 2 * thicknessCm, cut.opening.vHigh += 2 * thicknessCm;
    for (const PlanRing& ring : cut.holeIn(panel)) {
      Interval hole{1e300, -1e300};
      for (const PlanPoint& p : ring) hole = {std::min(hole.from, p.x), std::max(hole.to, p.x)};
      std::vector<Interval> rest;
      for (const Interval& i : out) {
        if (std::min(i.to, hole.from) > i.from + kTinyCm) rest.push_back({i.from, std::min(i.to, hole.from)});
        if (i.to > std::max(i.from, hole.to) + kTinyCm) rest.push_back({std::max(i.from, hole.to), i.to});
      }
      out = std::move(rest);
    }
  }
  return out;
}

PlanPoint along(PlanPoint a, PlanPoint b, double t) { return {a.x + (b.x - a.x) * t, a.y + (b.y - a.y) * t}; }

// The place on the wall's side that is nearest to one on the baseboard's front.
PlanPoint behind(PlanPoint p, PlanPoint a, PlanPoint b) {
  const double dx = b.x - a.x, dy = b.y - a.y, square = dx * dx + dy * dy;
  return square > 0 ? along(a, b, std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / square, 0.0, 1.0)) : a;
}

struct Side {
  const PlanRing &wall, &board;
  const Baseboard& baseboard;
  int material = 0;
  double floorCm = 0;
};

void addSide(const Side& side, const std::vector<double>& topCm, std::span<const WallCut> cuts, Surfaces& out) {
  for (size_t i = 0; i + 1 < side.board.size(); ++i) {
    const double top = std::min(side.floorCm + side.baseboard.heightCm, std::min(topCm[i], topCm[i + 1]));
    const Panel panel{side.board[i], side.board[i + 1], side.floorCm, top, top};
    const double length = panel.lengthCm();
    if (length < kTinyCm || top < side.floorCm + kTinyCm) continue;
    for (const Interval& part : left(panel, side.baseboard.thicknessCm, cuts)) {
      const PlanPoint ends[2] = {along(panel.a, panel.b, part.from / length),
                                 along(panel.a, panel.b, part.to / length)};
      const PlanPoint a = side.wall[i], b = side.wall[i + 1];
      const PlanPoint backs[2] = {part.from > 0 ? behind(ends[0], a, b) : a,
                                  part.to < length ? behind(ends[1], a, b) : b};
      const auto corner = [&](PlanPoint p, double s, double h) {
        return SurfaceCorner{toWorld(p, h), {static_cast<float>(s / 100), static_cast<float>(-h / 100)}};
      };
      const Vec3 outwards = toWorld(ends[0], 0) - toWorld(backs[0], 0),
                 forward = toWorld(ends[1], 0) - toWorld(ends[0], 0);
      const double f = side.floorCm;
      out.quad(side.material,
               {corner(ends[0], part.from, f), corner(ends[1], part.to, f), corner(ends[1], part.to, top),
                corner(ends[0], part.from, top)},
               outwards);
      out.quad(side.material,
               {corner(backs[0], part.from, f), corner(backs[1], part.to, f), corner(backs[1], part.to, top),
                corner(backs[0], part.from, top)},
               -outwards);
      for (const double height : {f, top}) {
        const Vec3 up{0, height == f ? -1.0f : 1.0f, 0};
        out.quad(side.material,
                 {corner(ends[0], part.from, height), corner(ends[1], part.to, height),
                  corner(backs[1], part.to, height), corner(backs[0], part.from, height)},
                 up);
      }
      for (const size_t k : {size_t{0}, size_t{1}}) {
        out.quad(side.material,
                 {corner(ends[k], 0, f), corner(backs[k], 1, f), corner(backs[k], 1, top), corner(ends[k], 0, top)},
                 k == 0 ? -forward : forward);
      }
    }
  }
}

int materialOf(const Baseboard& board, const Paint& side, Paints& paints) {
  return board.paint.colour || board.paint.texture ? paints.material(board.paint, "baseboard")
                                                   : paints.plain(side, "baseboard");
}

}  // namespace

std::vector<WallOffsets> baseboardOffsets(const Home& home) {
  std::vector<WallOffsets> out;
  for (const Wall& w : home.walls) {
    const auto thickness = [](const std::optional<Baseboard>& b) { return b ? b->thicknessCm : 0; };
    out.push_back({w.thicknessCm / 2 + thickness(w.leftBaseboard), w.thicknessCm / 2 + thickness(w.rightBaseboard)});
  }
  return out;
}

void addBaseboards(const StandingWall& standing, const WallOutline& boards, Paints& paints, Surfaces& out) {
  const Wall& wall = standing.wall;
  const WallOutline& outline = standing.outline;
  const WallHeights& heights = standing.heights;
  if (boards.left.size() != outline.left.size()) return;
  if (wall.leftBaseboard) {
    addSide({outline.left, boards.left, *wall.leftBaseboard, materialOf(*wall.leftBaseboard, wall.left, paints),
             heights.floorCm},
            heights.leftTopCm, standing.cuts, out);
  }
  if (wall.rightBaseboard) {
    addSide({outline.right, boards.right, *wall.rightBaseboard, materialOf(*wall.rightBaseboard, wall.right, paints),
             heights.floorCm},
            heights.rightTopCm, standing.cuts, out);
  }
}

}  // namespace roomlight::importers::sh3d
