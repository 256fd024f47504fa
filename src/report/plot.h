// Plots as inline SVG.
#pragma once

#include <string>
#include <vector>

namespace roomlight::report {

// Values from `low` to `high` are drawn at `from` to `to`. On a logarithmic axis low and high are logarithms of
// base 10.
struct Axis {
  double low = 0, high = 1, from = 0, to = 1;
  bool isLogarithmic = false;

  double at(double value) const;
  // Of a logarithmic axis: 1, 2 and 5 times powers of ten; powers alone where it is long.
  std::vector<double> decadeTicks() const;
};

// From thirds of a decade to thirds of a decade, no shorter than half of one.
Axis logarithmicAxis(double least, double most, double from, double to);

// A drawing, element by element; the later lies over the earlier. `look`: attributes as SVG has them. `title`: text for
// who points at it; may be empty.
class Plot {
 public:
  // `label`: text for who does not see it; may be empty.
  Plot(double width, double height, const std::string& label = {});

  void line(double x1, double y1, double x2, double y2, const std::string& look, const std::string& title = {});
  void bar(double x, double y, double width, double height, const std::string& fill);
  void dot(double x, double y, double radius, const std::string& look, const std::string& title = {});
  void path(const std::string& d, const std::string& look, const std::string& title = {});
  void text(double x, double y, const std::string& words, const std::string& look = {});

  std::string svg() const { return svg_ + "</svg>"; }

 private:
  void add(const std::string& element, const std::string& look, const std::string& title);

  std::string svg_;
};

}  // namespace roomlight::report
