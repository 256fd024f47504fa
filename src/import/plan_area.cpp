#include "import/plan_area.h"

#include <polyclipping/clipper.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace roomlight::importers {
namespace {

ClipperLib::Paths toGrid(const PlanArea& area) {
  ClipperLib::Paths paths;
  for (const PlanRing& ring : area) {
    ClipperLib::Path path;
    for (const PlanPoint& p : ring) path.emplace_back(std::llround(p.x / kPlanGrid), std::llround(p.y / kPlanGrid));
    paths.push_back(std::move(path));
  }
  return paths;
}

PlanArea combined(const PlanArea& a, const PlanArea& b, ClipperLib::ClipType type) {
  ClipperLib::Clipper clipper;
  clipper.AddPaths(toGrid(a), ClipperLib::ptSubject, true);
  clipper.AddPaths(toGrid(b), ClipperLib::ptClip, true);
  ClipperLib::Paths paths;
  clipper.Execute(type, paths, ClipperLib::pftEvenOdd, ClipperLib::pftEvenOdd);
  PlanArea out;
  for (const ClipperLib::Path& path : paths) {
    PlanRing ring;
    for (const ClipperLib::IntPoint& p : path)
      ring.push_back({static_cast<double>(p.X) * kPlanGrid, static_cast<double>(p.Y) * kPlanGrid});
    out.push_back(std::move(ring));
  }
  return out;
}

struct Edge {
  PlanPoint a, b;  // a.x < b.x
  double yAt(double x) const {
    if (x == a.x) return a.y;
    if (x == b.x) return b.y;
    return a.y + (b.y - a.y) * ((x - a.x) / (b.x - a.x));
  }
};

// Over all edges, in how many of the strips between neighbouring coordinates each lies. `axis`: of x or of y.
size_t stripsCrossed(const PlanArea& area, double PlanPoint::*axis) {
  std::vector<double> cuts;
  for (const PlanRing& ring : area) {
    for (const PlanPoint& p : ring) cuts.push_back(p.*axis);
  }
  std::sort(cuts.begin(), cuts.end());
  cuts.erase(std::unique(cuts.begin(), cuts.end()), cuts.end());
  const auto at = [&](double v) { return std::lower_bound(cuts.begin(), cuts.end(), v) - cuts.begin(); };
  size_t strips = 0;
  for (const PlanRing& ring : area) {
    for (size_t i = 0; i < ring.size(); ++i)
      strips += static_cast<size_t>(std::abs(at(ring[i].*axis) - at(ring[(i + 1) % ring.size()].*axis)));
  }
  return strips;
}

struct Box {
  PlanPoint lo{1e300, 1e300}, hi{-1e300, -1e300};
  void add(PlanPoint p) {
    lo = {std::min(lo.x, p.x), std::min(lo.y, p.y)}, hi = {std::max(hi.x, p.x), std::max(hi.y, p.y)};
  }
  bool meets(const Box& o) const { return lo.x <= o.hi.x && o.lo.x <= hi.x && lo.y <= o.hi.y && o.lo.y <= hi.y; }
};

Box boxOf(const PlanArea& area) {
  Box box;
  for (const PlanRing& ring : area) {
    for (const PlanPoint& p : ring) box.add(p);
  }
  return box;
}

struct Line {
  PlanPoint a, b;
  Box box;
  int area = 0;  // whose it is
};

// The edges that may meet something in the box.
void addLines(const PlanArea& from, const Box& within, int area, std::vector<Line>& out) {
  for (const PlanRing& ring : from) {
    for (size_t i = 0; i < ring.size(); ++i) {
      Line line{ring[i], ring[(i + 1) % ring.size()], {}, area};
      line.box.add(line.a), line.box.add(line.b);
      if (line.box.meets(within)) out.push_back(line);
    }
  }
}

double sideOf(const Line& l, PlanPoint p) { return (l.b.x - l.a.x) * (p.y - l.a.y) - (l.b.y - l.a.y) * (p.x - l.a.x); }

// Not where they only touch.
bool cross(const Line& l, const Line& m) {
  if (!l.box.meets(m.box)) return false;
  const auto apart = [](double s, double t) { return (s < 0 && t > 0) || (s > 0 && t < 0); };
  return apart(sideOf(l, m.a), sideOf(l, m.b)) && apart(sideOf(m, l.a), sideOf(m, l.b));
}

struct Crossings {
  size_t found = 0, looks = 0;
};

constexpr size_t kLooksAStep = 32;

// Of the clipper's sweep along y.
size_t sweepSteps(const PlanArea& area) {
  constexpr size_t kStepsACorner = 8, kStripsAStep = 8;
  size_t corners = 0;
  for (const PlanRing& ring : area) corners += ring.size();
  return kStepsACorner * corners + stripsCrossed(area, &PlanPoint::y) / kStripsAStep;
}

// At a crossing it walks past the edges beside it.
size_t stepsACrossing(const std::vector<Line>& lines) { return 8 + lines.size() / 64; }

// A sweep along x: each line against those that have not ended yet. `within`: of one area, otherwise of different ones.
// Ends at more than so many found, or looks.
Crossings crossingsIn(std::vector<Line> lines, bool within, Crossings most) {
  std::sort(lines.begin(), lines.end(), [](const Line& l, const Line& m) { return l.box.lo.x < m.box.lo.x; });
  Crossings out;
  std::vector<const Line*> active;
  for (const Line& line : lines) {
    std::erase_if(active, [&](const Line* l) { return l->box.hi.x < line.box.lo.x; });
    for (const Line* other : active) {
      if (within || other->area != line.area) out.found += cross(*other, line) ? 1 : 0;
      if (out.found > most.found) return out;
    }
    out.looks += active.size();
    if (out.looks > most.looks) return out;
    active.push_back(&line);
  }
  return out;
}

void addTriangle(std::vector<PlanTriangle>& out, PlanPoint a, PlanPoint b, PlanPoint c) {
  if ((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x) > 0) out.push_back({a, b, c});
}

}  // namespace

PlanArea united(const PlanArea& a, const PlanArea& b) { return combined(a, b, ClipperLib::ctUnion); }
PlanArea intersected(const PlanArea& a, const PlanArea& b) { return combined(a, b, ClipperLib::ctIntersection); }
PlanArea subtracted(const PlanArea& a, const PlanArea& b) { return combined(a, b, ClipperLib::ctDifference); }

std::vector<PlanTriangle> trianglesOf(const PlanArea& area) {
  std::vector<Edge> edges;
  std::vector<double> cuts;
  for (const PlanRing& ring : area) {
    for (size_t i = 0; i < ring.size(); ++i) {
      const PlanPoint p = ring[i], q = ring[(i + 1) % ring.size()];
      cuts.push_back(p.x);
      if (p.x < q.x) edges.push_back({p, q});
      if (q.x < p.x) edges.push_back({q, p});
    }
  }
  std::sort(cuts.begin(), cuts.end());
  cuts.erase(std::unique(cuts.begin(), cuts.end()), cuts.end());
  std::sort(edges.begin(), edges.end(), [](const Edge& e, const Edge& f) { return e.a.x < f.a.x; });
  std::vector<PlanTriangle> out;
  std::vector<Edge> active;
  size_t next = 0;
  for (size_t c = 0; c + 1 < cuts.size(); ++c) {
    const double x0 = cuts[c], x1 = cuts[c + 1], middle = 0.5 * (x0 + x1);
    std::erase_if(active, [&](const Edge& e) { return e.b.x <= x0; });
    for (; next < edges.size() && edges[next].a.x <= x0; ++next) active.push_back(edges[next]);
    std::sort(active.begin(), active.end(),
              [&](const Edge& e, const Edge& f) { return e.yAt(middle) < f.yAt(middle); });
    for (size_t i = 0; i + 1 < active.size(); i += 2) {
      const PlanPoint a{x0, active[i].yAt(x0)}, b{x1, active[i].yAt(x1)}, d{x0, active[i + 1].yAt(x0)},
          e{x1, active[i + 1].yAt(x1)};
      addTriangle(out, a, b, e);
      addTriangle(out, a, e, d);
    }
  }
  return out;
}

size_t mostTrianglesOf(const PlanArea& area) { return stripsCrossed(area, &PlanPoint::x); }

size_t combiningSteps(const PlanArea& a, const PlanArea& b, size_t most) {
  const size_t steps = sweepSteps(a) + sweepSteps(b);
  if (steps > most) return steps;
  std::vector<Line> lines;
  addLines(a, boxOf(b), 0, lines);
  addLines(b, boxOf(a), 1, lines);
  const size_t each = stepsACrossing(lines), left = std::min(most - steps, size_t{1} << 48);
  const Crossings crossings = crossingsIn(std::move(lines), false, {left / each, kLooksAStep * left});
  return steps + crossings.looks / kLooksAStep + crossings.found * each;
}

Tangle tangleOf(const PlanArea& area, size_t mostCrossings) {
  std::vector<Line> lines;
  addLines(area, boxOf(area), 0, lines);
  const size_t each = stepsACrossing(lines);
  const Crossings own = crossingsIn(std::move(lines), true, {mostCrossings, std::numeric_limits<size_t>::max()});
  const size_t looking = own.looks / kLooksAStep;
  if (own.found > mostCrossings) return {own.found, looking};
  return {own.found, looking + sweepSteps(area) + own.found * each};
}

double signedAreaOf(const PlanRing& ring) {
  double sum = 0;
  for (size_t i = 0; i < ring.size(); ++i) {
    const PlanPoint p = ring[i], q = ring[(i + 1) % ring.size()];
    sum += p.x * q.y - p.y * q.x;
  }
  return sum / 2;
}

double areaOf(const PlanArea& area) {
  double sum = 0;
  for (const PlanTriangle& t : trianglesOf(area)) sum += signedAreaOf({t[0], t[1], t[2]});
  return sum;
}

}  // namespace roomlight::importers
