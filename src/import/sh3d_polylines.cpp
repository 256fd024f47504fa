#include "import/sh3d_plan.h"

#include <algorithm>
#include <cmath>

#include "import/sh3d_draft.h"

namespace roomlight::importers::sh3d {
namespace {

constexpr double kLowestCm = 0.05;

// Half a thickness longer at both ends, so that neighbours meet at their corner.
void addBand(PlanPoint a, PlanPoint b, double thicknessCm, double heightCm, int material, Surfaces& surfaces) {
  const double length = std::hypot(b.x - a.x, b.y - a.y);
  if (!(length > 0)) return;
  const double half = thicknessCm / 2, ux = (b.x - a.x) / length * half, uy = (b.y - a.y) / length * half;
  const auto corner = [&](PlanPoint p, double along, double across) {
    const PlanPoint q{p.x + along * ux - across * uy, p.y + along * uy + across * ux};
    return SurfaceCorner{toWorld(q, heightCm), {static_cast<float>(q.x / 100), static_cast<float>(q.y / 100)}};
  };
  surfaces.quad(material, {corner(a, -1, -1), corner(b, 1, -1), corner(b, 1, 1), corner(a, -1, 1)}, {0, 1, 0});
}

}  // namespace

void addPolylines(const Home& home, Paints& paints, Draft& draft) {
  for (const Polyline& line : home.polylines) {
    if (!isShown(home, line.level) || line.points.size() < 2 || !(line.thicknessCm > 0)) continue;
    Paint paint;
    paint.colour = line.colour;
    const int material = paints.material(paint, "line");
    const double heightCm = elevationOf(home, line.level) + std::max(line.elevationCm, kLowestCm);
    Surfaces surfaces(draft.effort, line.place);
    surfaces.ask(2 * line.points.size());
    for (size_t i = 0; i + 1 < line.points.size(); ++i)
      addBand(line.points[i], line.points[i + 1], line.thicknessCm, heightCm, material, surfaces);
    if (line.closed) addBand(line.points.back(), line.points.front(), line.thicknessCm, heightCm, material, surfaces);
    surfaces.finish(draft, "line");
    ++draft.object;
  }
}

}  // namespace roomlight::importers::sh3d
