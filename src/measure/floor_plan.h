// A scene cut by a horizontal plane, as lines of a drawing.
#pragma once

#include <vector>

#include "scene/scene.h"

namespace roomlight {

// Where the drawing lies: its origin on the plane and its axes, and how large it is.
struct PlanFrame {
  Vec3 origin, u{1, 0, 0}, v{0, 0, 1};
  Vec2 low, high;  // in metres along u and v
};

using PlanLine = std::vector<Vec2>;  // in the frame, metres

// What surfaces the plane through frame.origin cuts, joined to long lines on a raster of a centimetre, coarser where
// that would make more than 20 000 points. Lines shorter than 4 cm (leaves, fringes) are left out. Costs a pass over
// all triangles.
std::vector<PlanLine> cutPlan(const Scene& scene, const PlanFrame& frame);

}  // namespace roomlight
