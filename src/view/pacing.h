// How large pictures may be so that they come in time, and how JPEG follows the line: from what was measured so far.
#pragma once

#include <cstddef>
#include <utility>

namespace roomlight::view {

// Of one technique: what a picture costs.
class Pace {
 public:
  // Pixels along both edges for a picture of the aspect of `whole` that takes `ms`, or whole where that is quick enough.
  std::pair<int, int> sizeFor(double ms, std::pair<int, int> whole) const;
  void took(std::pair<int, int> size, double ms);

 private:
  double msPerMegapixel_ = 400;  // before anything was measured
};

// Of one browser.
class Line {
 public:
  void sent(size_t bytes, double ms);  // until it was acknowledged
  int quality() const;                 // of JPEG: 50 to 90
  // Of the picture's edges, 1 on a line that is quick enough.
  float scale() const;

 private:
  double bytesPerMs_ = 2e4;  // 20 MB/s before anything was measured
  double bytesAFrame_ = 0;
};

}  // namespace roomlight::view
