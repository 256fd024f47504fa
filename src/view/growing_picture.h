// A picture that grows better as long as nothing moves: first quick frames, small
// where they must be, then the average of more and more whole pictures,
// then, where somebody traces paths for it, put right by these.
#pragma once

#include <atomic>
#include <memory>
#include <utility>

#include "base/progress.h"
#include "view/frame.h"
#include "engine/technique.h"

namespace roomlight::view {

class GrowingPicture {
 public:
  // From here on the picture is another one.
  void restart() { *this = {}; }
  // A first picture, or another: quickly made, and `reduced` where it is smaller than the whole.
  void showQuick(Image image, double pictureMs, bool reduced);
  bool begun() const { return image_ != nullptr; }
  bool settled() const { return settled_; }
  bool averaged() const { return averaged_; }  // step() has no more to do

  // Of refineByPath()'s kind: by paths, of which so many were traced.
  void refine(Image image, uint32_t samples, float relativeError, bool last);

  struct Kind {
    bool white;    // PictureWish::white, always the same until restart()
    bool refines;  // after it is averaged somebody refines it
  };
  // Adds to the average of whole pictures; one of another size begins anew. True: there is something new to show. Given
  // up, without a trace, when `newer` becomes true.
  bool step(const LitScene& lit, const Camera& camera, std::pair<int, int> whole, Kind kind,
            const std::atomic<bool>& newer);

  const Image& image() const { return *image_; }  // cd/m²
  std::shared_ptr<const Image> shared() const { return image_; }  // stays as it is
  uint32_t samples() const { return samples_; }
  uint32_t samplesInAll() const { return samplesInAll_; }  // with which it is averaged; 0 before and after that
  double pictureMs() const { return pictureMs_; }
  bool quick() const { return quick_; }
  bool refined() const { return refined_; }
  float relativeError() const { return relativeError_; }

 private:
  std::shared_ptr<const Image> image_;
  Image sum_;
  uint32_t samples_ = 0, samplesInAll_ = 0, shownAt_ = 0;
  Stopwatch sinceQuick_;
  double pictureMs_ = 0;
  float relativeError_ = FrameInfo::kNone;
  bool quick_ = false, averaged_ = false, refined_ = false, settled_ = false;
};

}  // namespace roomlight::view
