// How large pictures may be so that they come in time, and how JPEG follows the line: from what was measured so far.
#pragma once

#include <cstddef>
#include <utility>

namespace roomlight::view {

// Of one window's frames: what they cost.
class Pace {
 public:
  // Pixels along both edges for a frame of the aspect of `whole` that takes about `ms`; at most whole, and at most
  // 960x540 of them. In steps, not to and fro, and up only once some frames of a size have shown what they take: frames
  // of another size have less to take over from those before.
  std::pair<int, int> sizeFor(double ms, std::pair<int, int> whole);
  void took(std::pair<int, int> size, double ms);

 private:
  double msPerMegapixel_ = 400;  // before anything was measured
  int step_ = 0;  // down from the whole; four of them halve the edges
  int measured_ = 0;  // frames since it changed
};

// Of one browser.
class Line {
 public:
  void sent(size_t bytes, double ms);  // until it was acknowledged
  int quality() const;  // of JPEG: 50 to 90
  // Of the edges of quick pictures: 1 on a line that is quick enough, else in steps, since frames take over points only
  // from those of about their size.
  float scale() const;

 private:
  double bytesPerMs_ = 2e4;  // 20 MB/s before anything was measured
  double bytesAFrame_ = 0;
};

}  // namespace roomlight::view
