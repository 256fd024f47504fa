#include "import/sh3d_openings.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace roomlight::importers::sh3d {
namespace {

constexpr size_t kStepsAPoint = 8;

// In the unit square.
PlanArea shapeOf(const Piece& p, Effort& effort, Warnings& warnings) {
  const PlanArea whole{{{0, 0}, {0, 1}, {1, 1}, {1, 0}}};
  if (p.door.cutOutShape.empty()) return whole;
  PlanArea unit = svgPath(p.door.cutOutShape);
  if (unit.empty()) {
    warnings.add("cut-out shapes that cannot be read are taken as rectangles");
  } else if (!effort.untangles(unit, p.place)) {
    warnings.add(fmt::format("cut-out shapes that cross themselves more than {} times are taken as rectangles",
                             Effort::kMostOwnCrossings));
  } else {
    return unit;
  }
  return whole;
}

}  // namespace

std::vector<Opening> openingsOf(const Home& home, Effort& effort, Warnings& warnings) {
  std::vector<Opening> out;
  for (const Piece& p : home.pieces) {
    if (p.kind != PieceKind::DoorOrWindow || !isShown(home, p.level)) continue;
    if (!(p.widthCm > 0) || !(p.heightCm > 0)) continue;
    Opening o;
    o.along = {std::cos(p.angleRad), std::sin(p.angleRad)};
    o.vLow = o.v(p.centre) - p.depthCm / 2, o.vHigh = o.v(p.centre) + p.depthCm / 2;
    o.bothSides = p.door.cutOutOnBothSides;
    const double uLow = o.u(p.centre) - p.widthCm / 2, top = elevationOf(home, p.level) + p.elevationCm + p.heightCm;
    PlanArea unit = shapeOf(p, effort, warnings);
    for (PlanRing& ring : unit) {
      for (PlanPoint& q : ring) {
        const double x = p.mirrored ? 1 - q.x : q.x;
        q = {uLow + x * p.widthCm, top - q.y * p.heightCm};
      }
    }
    o.shape = united(unit, {});
    o.points = combiningSteps(o.shape, {}, std::numeric_limits<uint32_t>::max()) / kStepsAPoint;
    o.centre = p.centre;
    o.radiusCm = std::hypot(p.depthCm / 2, p.widthCm / 2);
    if (!o.shape.empty()) out.push_back(std::move(o));
  }
  return out;
}

}  // namespace roomlight::importers::sh3d
