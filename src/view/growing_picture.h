// A picture that grows better as long as nothing moves: first a quick frame that reuses the light of those before, small
// where it must be, then the average of more and more whole pictures,
// then, where somebody traces paths for it, put right by these.
#pragma once

#include <atomic>
#include <utility>

#include "base/clock.h"
#include "view/frame.h"
#include "view/lit_home.h"
#include "view/pacing.h"

namespace roomlight::view {

struct QuickFrame {
  double ms;              // that it may take
  Pace& pace;
  FrameHistory* history;  // null: none
};

class GrowingPicture {
 public:
  // From here on the picture is another one.
  void restart() { *this = {}; }
  bool begun() const { return image_.width > 0; }
  bool settled() const { return settled_; }
  bool averaged() const { return averaged_; }  // step() has no more to do

  // Of refine.h's kind: by paths, of which so many were traced.
  void refine(Image image, uint32_t samples, float relativeError, bool last);

  // Takes the next step; `refines`: after it is averaged somebody refines it. True: there is something new to show. All but the first step are given up, without a trace, when
  // `newer` becomes true.
  bool step(const LitHome& home, const Camera& camera, std::pair<int, int> whole, const QuickFrame& quick, bool refines, const std::atomic<bool>& newer, const std::atomic<bool>& stop);

  const Image& image() const { return image_; }  // cd/m²
  uint32_t samples() const { return samples_; }
  double pictureMs() const { return pictureMs_; }
  bool quick() const { return quick_; }
  bool refined() const { return refined_; }
  float relativeError() const { return relativeError_; }

 private:
  bool quickStep(const LitHome& home, const Camera& camera, std::pair<int, int> whole, const QuickFrame& quick, const std::atomic<bool>& stop);

  Image image_;
  Image sum_;
  uint32_t samples_ = 0, shownAt_ = 0;
  Stopwatch sinceQuick_;
  double pictureMs_ = 0;
  float relativeError_ = FrameInfo::kNone;
  bool quick_ = false, averaged_ = false, refined_ = false, settled_ = false;
};

}  // namespace roomlight::view
