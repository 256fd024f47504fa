// Where a field of values passes a level: closed lines by marching squares.
#pragma once

#include <span>
#include <vector>

#include "base/vec.h"

namespace roomlight {

struct ContourPoint {
  Vec2 p;            // in cells: (0.5, 0.5) is the middle of the first
  bool rim = false;  // on the edge of the field, where the line only closes
};

// Lines around all that is at least `level`, which lies to one side of each all along; together, filled by the even-odd
// rule, they are that region. Values must be numbers, row by row; between cell middles they are linear.
std::vector<std::vector<ContourPoint>> contours(std::span<const float> values, int columns, int rows, float level);

// A field with its gaps (not a number) filled from their neighbours, for drawing.
std::vector<float> withoutGaps(std::span<const float> values, int columns, int rows);

}  // namespace roomlight
