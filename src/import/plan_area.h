// Areas of a plane with holes: what remains of a floor under stairs or of a wall around a window.
#pragma once

#include <array>
#include <cstddef>
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

// What the work on areas comes to, told before any of it is done.
// At least as many triangles as trianglesOf() makes, and hardly more.
size_t mostTrianglesOf(const PlanArea& area);
// Steps, of about a tenth of a microsecond, of one of the operations above on two areas that do not cross themselves:
// for each corner, for edges that lie side by side, for each place where the two cross. Counting ends beyond `most`.
size_t combiningSteps(const PlanArea& a, const PlanArea& b, size_t most);
// Pairs of its own edges that cross, and the steps of uniting it with nothing, which ends all crossings. Counting ends
// beyond so many crossings; then the steps are those of counting.
struct Tangle {
  size_t crossings = 0, steps = 0;
};
Tangle tangleOf(const PlanArea& area, size_t mostCrossings);

double areaOf(const PlanArea& area);
double signedAreaOf(const PlanRing& ring);  // positive counter-clockwise

}  // namespace roomlight::importers
