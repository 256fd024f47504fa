// A storey as an architect draws it, cut at 1.2 m, with what was found in each room and where the luminaires are.
 // Inline SVG.
#pragma once

#include <string>
#include <vector>

#include "measure/measurements.h"

namespace roomlight {

struct OverviewPlan {
  float elevationM = 0;  // of the storey's lowest floor
  std::string svg;
};

// One for each storey with rooms, the lowest first. Luminaires bear the numbers of their rows in the schedule, from 1
// on. Costs a pass over all triangles a storey.
std::vector<OverviewPlan> overviewPlans(const Measurements& m, const Scene& scene, const Schedule& schedule);

// How a page shows them.
extern const char* const kOverviewPlanStyle;

}  // namespace roomlight
