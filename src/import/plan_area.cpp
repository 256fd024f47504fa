#include "import/plan_area.h"

#include <polyclipping/clipper.hpp>

#include <algorithm>
#include <cmath>

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
