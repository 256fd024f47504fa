// The border of a chart on its plane, and places that keep off it.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "base/vec.h"

namespace roomlight::bake {

class ChartBorder {
 public:
  // Empty: nothing is kept off.
  ChartBorder() = default;
  // Triangles as the plane has them, m along its axes; those that share an edge have the same corners there.
  explicit ChartBorder(std::span<const std::array<Vec2, 3>> triangles);
  bool empty() const { return edges_.empty(); }
  // The mean width, as of a band along half of the border.
  float widthM() const { return widthM_; }
  // A place of the chart, moved inwards across the border's edges that it is less than `byM` off, until it is. Where
  // the chart is narrower it may come to lie outside.
  Vec2 inset(Vec2 place, float byM) const;

 private:
  struct Edge {
    Vec2 from, along, inwards;  // unit
    float length;
  };
  std::vector<Edge> edges_;  // of one triangle alone
  float widthM_ = kInfinity;
};

}  // namespace roomlight::bake
