// What reports draw: contours, plans, and pictures of the light on a surface. Inline SVG.
#pragma once

#include <cmath>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "base/vec.h"
#include "measure/false_colour.h"
#include "measure/measurements.h"
#include "scene/scene.h"

namespace roomlight {

// Where a field of values passes a level: closed lines by marching squares.
struct ContourPoint {
  Vec2 p;            // in cells: (0.5, 0.5) is the middle of the first
  bool rim = false;  // on the edge of the field, where the line only closes
};

// Lines around all that is at least `level`, which lies to one side of each all along; together, filled by the even-odd
// rule, they are that region. Values must be numbers, row by row; between cell middles they are linear.
std::vector<std::vector<ContourPoint>> contours(std::span<const float> values, int columns, int rows, float level);

// A field with its gaps (not a number) filled from their neighbours, for drawing.
std::vector<float> withoutGaps(std::span<const float> values, int columns, int rows);

// Where the drawing of a scene cut by a horizontal plane lies: its origin on the plane and its
// axes, and how large it is.
struct PlanFrame {
  Vec3 origin, u{1, 0, 0}, v{0, 0, 1};
  Vec2 low, high;  // in metres along u and v
};

using PlanLine = std::vector<Vec2>;  // in the frame, metres

// What surfaces the plane through frame.origin cuts, joined to long lines on a raster of a centimetre, coarser where
// that would make more than 20 000 points. Lines shorter than 4 cm (leaves, fringes) are left out. Costs a pass over
// all triangles.
std::vector<PlanLine> cutPlan(const Scene& scene, const PlanFrame& frame);

// Pictures are drawn in whole centimetres.
inline int cm(float metres) { return static_cast<int>(std::lround(metres * 100)); }
// Paths of SVG: through points in metres, or around the cells that a lattice uses, whose corners `place` finds.
std::string pathOf(std::span<const Vec2> metres, bool isClosed);
std::string pathOf(std::span<const PlanLine> lines);
std::string pathOf(const MeterGrid& lattice, const std::function<Vec2(Vec2 cells)>& place);
// The begin of a picture from `low` on, `sizeCm` large, drawn with so many centimetres a pixel. `kind`: its class.
std::string openSvg(const std::string& kind, const std::string& label, Vec2 low, Vec2 sizeCm, float cmAPixel);

// A picture of the light on a surface: colours, contours, the plan around it, lamps and a length to compare with.
// `number` tells the pictures of one page apart. Some ten to hundred kilobytes.
std::string lightMapSvg(const GridReading& grid, const Scene& scene, const LightScale& scale, int number);
// How a page shows them.
extern const char* const kLightMapStyle;
// Colours and what they mean.
std::string legendSvg(const LightScale& scale, const std::string& unit);

// A storey as an architect draws it, cut at 1.2 m, with what was found in each room and where the luminaires are.
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
