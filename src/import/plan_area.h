// Areas of a plane with holes: what remains of a floor under stairs or of a wall around a window.
#pragma once

#include <array>
#include <vector>

namespace roomlight::importers {

struct PlanPoint {
  double x = 0, y = 0;
};
using PlanRing = std::vector<PlanPoint>;
using PlanArea = std::vector<PlanRing>;  // inside by the even-odd rule

// Coordinates are rounded to kPlanGrid of their unit and must stay below 1e8 of it. Rings come out without crossings.
constexpr double kPlanGrid = 1e-4;
PlanArea united(const PlanArea& a, const PlanArea& b);
PlanArea intersected(const PlanArea& a, const PlanArea& b);
PlanArea subtracted(const PlanArea& a, const PlanArea& b);

// Of rings that do not cross. Counter-clockwise where x points right and y up. Vertical cuts through every corner:
// corners on a common cut have the very same x, so that neighbours leave no gap. Takes time and space of corners times
// edges on a cut.
using PlanTriangle = std::array<PlanPoint, 3>;
std::vector<PlanTriangle> trianglesOf(const PlanArea& area);

double areaOf(const PlanArea& area);
double signedAreaOf(const PlanRing& ring);  // positive counter-clockwise

}  // namespace roomlight::importers
