#include "view/growing_picture.h"

#include "base/clock.h"
#include "base/parallel.h"

namespace roomlight::view {
namespace {

constexpr uint32_t kMostAverages = 64, kBeforePaths = 24;
constexpr double kShowAgain = 1.4;  // times the samples of what was shown last

}  // namespace

bool GrowingPicture::step(LitHome& home, const Camera& camera, std::pair<int, int> whole, double quickMs, bool refines, const std::atomic<bool>& newer, const std::atomic<bool>& stop) {
  const std::pair<int, int> small = home.pace.sizeFor(quickMs, whole);
  const bool first = quickNext(), quick = first && small != whole;
  const auto [width, height] = quick ? small : whole;
  const Stopwatch watch;
  const Image next = home.lit->pictureOf(camera, {width, height, 1, samples_}, {{}, first ? &stop : &newer});
  if ((first ? stop : newer).load() || next.width == 0) return false;
  pictureMs_ = watch.seconds() * 1e3;
  home.pace.took({width, height}, pictureMs_);
  quick_ = quick;
  if (quick) {
    image_ = next;
    return true;
  }
  if (samples_ == 0) {
    sum_ = next;
  } else {
    parallelFor(sum_.pixels.size(), 16384, [&](size_t i) { sum_.pixels[i] += next.pixels[i]; });
  }
  ++samples_;
  averaged_ = samples_ >= (refines ? kBeforePaths : kMostAverages);
  settled_ = averaged_ && !refines;
  if (!averaged_ && samples_ > 1 && samples_ < kShowAgain * shownAt_) return false;
  shownAt_ = samples_;
  image_ = sum_;
  const float share = 1 / static_cast<float>(samples_);
  parallelFor(image_.pixels.size(), 16384, [&](size_t i) { image_.pixels[i] *= share; });
  return true;
}

void GrowingPicture::refine(Image image, uint32_t samples, float relativeError, bool last) {
  image_ = std::move(image);
  samples_ = samples, relativeError_ = relativeError;
  refined_ = true, settled_ = last;
}

}  // namespace roomlight::view
