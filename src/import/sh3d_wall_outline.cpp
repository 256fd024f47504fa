#include "import/sh3d_wall_parts.h"

#include <algorithm>
#include <cmath>

namespace roomlight::importers::sh3d {
namespace {

constexpr double kChordErrorCm = 0.1;
constexpr int kMostChords = 256;
constexpr double kShortestCm = 1e-3;

double distance(PlanPoint a, PlanPoint b) { return std::hypot(b.x - a.x, b.y - a.y); }

WallOutline straight(const Wall& w, WallOffsets o) {
  const double length = distance(w.start, w.end);
  // Left of a direction on the plan, whose y points down.
  const double nx = (w.end.y - w.start.y) / length, ny = -(w.end.x - w.start.x) / length;
  const auto moved = [&](PlanPoint p, double by) { return PlanPoint{p.x + nx * by, p.y + ny * by}; };
  return {{moved(w.start, o.leftCm), moved(w.end, o.leftCm)}, {moved(w.start, -o.rightCm), moved(w.end, -o.rightCm)}};
}

bool isRound(const Wall& w) { return std::abs(w.arcExtentRad) > 1e-3 && std::abs(w.arcExtentRad) < 6.282; }

// The arc's centre lies on the perpendicular bisector of its chord, chord / 2 / tan(extent / 2) to the right: a
// positive extent bulges to the left, one beyond half a turn puts the centre on the other side.
struct Arc {
  PlanPoint centre;
  double radius = 0;
};

Arc arcOf(const Wall& w) {
  const double length = distance(w.start, w.end);
  const double nx = (w.end.y - w.start.y) / length, ny = -(w.end.x - w.start.x) / length;
  const double toCentre = length / 2 / std::tan(w.arcExtentRad / 2);
  const PlanPoint centre{(w.start.x + w.end.x) / 2 - nx * toCentre, (w.start.y + w.end.y) / 2 - ny * toCentre};
  return {centre, distance(centre, w.start)};
}

WallOutline round(const Wall& w, WallOffsets o) {
  const Arc arc = arcOf(w);
  const PlanPoint centre = arc.centre;
  const double extent = w.arcExtentRad, first = std::atan2(w.start.y - centre.y, w.start.x - centre.x);
  // From start to end with the centre at the right means clockwise on the plan: the angle grows, as y points down.
  const auto chords = static_cast<int>(chordsOf(w, o));
  const double side = extent > 0 ? 1 : -1;  // left is outside
  WallOutline out;
  for (int i = 0; i <= chords; ++i) {
    const double angle = first + extent * i / chords;
    const auto at = [&](double r) { return PlanPoint{centre.x + r * std::cos(angle), centre.y + r * std::sin(angle)}; };
    out.left.push_back(at(std::max(arc.radius + side * o.leftCm, 0.0)));
    out.right.push_back(at(std::max(arc.radius - side * o.rightCm, 0.0)));
  }
  return out;
}

// A side's end and the corner before it.
struct SideEnd {
  PlanPoint corner, before;
};

SideEnd sideEnd(const PlanRing& side, bool atStart) {
  return atStart ? SideEnd{side.front(), side[1]} : SideEnd{side.back(), side[side.size() - 2]};
}

// Where the lines of the two sides meet; the corner itself where they are nearly parallel or meet farther away than
// `limit`.
PlanPoint met(const SideEnd& a, const SideEnd& b, double limit) {
  const double ax = a.before.x - a.corner.x, ay = a.before.y - a.corner.y, bx = b.before.x - b.corner.x,
               by = b.before.y - b.corner.y;
  const double cross = ax * by - ay * bx;
  if (std::abs(cross) <= 1e-5 * std::hypot(ax, ay) * std::hypot(bx, by)) return a.corner;
  const double t = ((b.corner.x - a.corner.x) * by - (b.corner.y - a.corner.y) * bx) / cross;
  const PlanPoint meeting{a.corner.x + ax * t, a.corner.y + ay * t};
  return distance(meeting, a.corner) <= limit ? meeting : a.corner;
}

class Joiner {
 public:
  Joiner(const Home& home, const std::vector<WallOutline>& bare) : home_(home), bare_(bare) {}

  void join(size_t wall, bool atStart, WallOutline& out) const {
    const Wall& own = home_.walls[wall];
    const int other = atStart ? own.atStart : own.atEnd;
    if (other < 0 || static_cast<size_t>(other) == wall) return;
    const Wall& neighbour = home_.walls[static_cast<size_t>(other)];
    const WallOutline &a = bare_[wall], &b = bare_[static_cast<size_t>(other)];
    if (a.left.empty() || b.left.empty() || neighbour.level != own.level) return;
    bool byStart = neighbour.atStart == static_cast<int>(wall), byEnd = neighbour.atEnd == static_cast<int>(wall);
    if (byStart && byEnd) {  // two walls that are joined at both ends
      const PlanPoint here = atStart ? own.start : own.end;
      byStart = distance(neighbour.start, here) <= distance(neighbour.end, here);
      byEnd = !byStart;
    }
    if (!byStart && !byEnd) return;
    // Two walls that run on into each other share their left side, two that start or end together do not.
    const bool crossed = atStart == byStart;
    const double limit = 2 * own.thicknessCm;
    const PlanPoint left = met(sideEnd(a.left, atStart), sideEnd(crossed ? b.right : b.left, byStart), limit);
    const PlanPoint right = met(sideEnd(a.right, atStart), sideEnd(crossed ? b.left : b.right, byStart), limit);
    (atStart ? out.left.front() : out.left.back()) = left;
    (atStart ? out.right.front() : out.right.back()) = right;
  }

 private:
  const Home& home_;
  const std::vector<WallOutline>& bare_;
};

}  // namespace

PlanRing WallOutline::ring() const {
  PlanRing out = left;
  out.insert(out.end(), right.rbegin(), right.rend());
  return out;
}

size_t chordsOf(const Wall& w, WallOffsets o) {
  if (distance(w.start, w.end) < kShortestCm) return 0;
  if (!isRound(w)) return 1;
  const double outer = arcOf(w).radius + std::max(o.leftCm, o.rightCm);
  const double step = 2 * std::acos(std::clamp(1 - kChordErrorCm / outer, -1.0, 1.0));
  const double needed = std::ceil(std::abs(w.arcExtentRad) / std::max(step, 1e-3));
  return static_cast<size_t>(std::clamp(static_cast<int>(needed), 2, kMostChords));
}

std::vector<WallOutline> wallOutlines(const Home& home, const std::vector<WallOffsets>& offsets) {
  std::vector<WallOutline> bare(home.walls.size());
  for (size_t i = 0; i < bare.size(); ++i) {
    const Wall& w = home.walls[i];
    if (!isShown(home, w.level) || distance(w.start, w.end) < kShortestCm) continue;
    bare[i] = isRound(w) ? round(w, offsets[i]) : straight(w, offsets[i]);
  }
  std::vector<WallOutline> out = bare;
  const Joiner joiner(home, bare);
  for (size_t i = 0; i < out.size(); ++i) {
    joiner.join(i, true, out[i]);
    joiner.join(i, false, out[i]);
  }
  return out;
}

std::vector<WallOutline> wallOutlines(const Home& home) {
  std::vector<WallOffsets> offsets;
  for (const Wall& w : home.walls) offsets.push_back({w.thicknessCm / 2, w.thicknessCm / 2});
  return wallOutlines(home, offsets);
}

double wallHeightCm(const Home& home, const Wall& wall, PlanPoint at) {
  const double start = wall.heightCm.value_or(home.wallHeightCm), end = wall.heightAtEndCm.value_or(start);
  const double x = wall.end.x - wall.start.x, y = wall.end.y - wall.start.y;
  return std::max(0.0,
                  start + (end - start) * ((at.x - wall.start.x) * x + (at.y - wall.start.y) * y) / (x * x + y * y));
}

}  // namespace roomlight::importers::sh3d
