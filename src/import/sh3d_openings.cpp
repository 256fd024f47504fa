#include "import/sh3d_openings.h"

#include <algorithm>
#include <cmath>

namespace roomlight::importers::sh3d {
std::vector<Opening> openingsOf(const Home& home, Warnings& warnings) {
  std::vector<Opening> out;
  for (const Piece& p : home.pieces) {
    if (p.kind != PieceKind::DoorOrWindow || !isShown(home, p.level)) continue;
    if (!(p.widthCm > 0) || !(p.heightCm > 0)) continue;
    Opening o;
    o.along = {std::cos(p.angleRad), std::sin(p.angleRad)};
    o.vLow = o.v(p.centre) - p.depthCm / 2, o.vHigh = o.v(p.centre) + p.depthCm / 2;
    o.bothSides = p.door.cutOutOnBothSides;
    const double uLow = o.u(p.centre) - p.widthCm / 2, top = elevationOf(home, p.level) + p.elevationCm + p.heightCm;
    PlanArea unit = p.door.cutOutShape.empty() ? PlanArea() : svgPath(p.door.cutOutShape);
    if (unit.empty()) {
      if (!p.door.cutOutShape.empty()) warnings.add("cut-out shapes that cannot be read are taken as rectangles");
      unit = {{{0, 0}, {0, 1}, {1, 1}, {1, 0}}};
    }
    for (PlanRing& ring : unit) {
      for (PlanPoint& q : ring) {
        const double x = p.mirrored ? 1 - q.x : q.x;
        q = {uLow + x * p.widthCm, top - q.y * p.heightCm};
      }
    }
    o.shape = united(unit, {});
    for (const PlanRing& ring : o.shape) o.points += ring.size();
    o.centre = p.centre;
    o.radiusCm = std::hypot(p.depthCm / 2, p.widthCm / 2);
    if (!o.shape.empty()) out.push_back(std::move(o));
  }
  return out;
}

}  // namespace roomlight::importers::sh3d
