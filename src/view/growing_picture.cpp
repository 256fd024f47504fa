#include "view/growing_picture.h"

#include "base/parallel.h"

namespace roomlight::view {
namespace {

constexpr uint32_t kMostAverages = 64, kBeforePaths = 24;
constexpr uint32_t kOneByOne = 4, kTogether = 4;
constexpr double kShowAgain = 1.4;  // times the samples of what was shown last
// The first average is shown with so many, or after so long: with fewer it would be noisier than the frame that reused light.
constexpr uint32_t kFirstShown = 4;
constexpr double kFirstShownS = 0.3;

}  // namespace

bool GrowingPicture::quickStep(const LitHome& home, const Camera& camera, std::pair<int, int> whole, const QuickFrame& quick, const std::atomic<bool>& stop) {
  const std::pair<int, int> size = quick.pace.sizeFor(quick.ms, whole);
  const Stopwatch watch;
  Image next = home.lit->pictureOf(camera, {size.first, size.second, 1, {}, quick.history}, {{}, &stop});
  if (stop || next.width == 0) return false;
  pictureMs_ = watch.seconds() * 1e3;
  quick.pace.took(size, pictureMs_);
  quick_ = size != whole;
  image_ = std::move(next);
  sinceQuick_ = Stopwatch();
  return true;
}

bool GrowingPicture::step(const LitHome& home, const Camera& camera, std::pair<int, int> whole, const QuickFrame& quick, bool refines, const std::atomic<bool>& newer, const std::atomic<bool>& stop) {
  if (!begun()) return quickStep(home, camera, whole, quick, stop);
  const Stopwatch watch;
  // A few together cost less than one by one, but at first somebody waits.
  const uint32_t count = samples_ < kOneByOne ? 1 : kTogether;
  const Image next = home.lit->pictureOf(camera, {whole.first, whole.second, static_cast<int>(count), samples_, nullptr}, {{}, &newer});
  if (newer || next.width == 0) return false;
  pictureMs_ = watch.seconds() * 1e3;
  if (samples_ == 0) sum_ = Image(next.width, next.height);
  parallelFor(sum_.pixels.size(), 16384, [&](size_t i) { sum_.pixels[i] += next.pixels[i] * static_cast<float>(count); });
  samples_ += count;
  averaged_ = samples_ >= (refines ? kBeforePaths : kMostAverages);
  settled_ = averaged_ && !refines;
  const bool worth = shownAt_ == 0 ? samples_ >= kFirstShown || sinceQuick_.seconds() > kFirstShownS : samples_ >= kShowAgain * shownAt_;
  if (!averaged_ && !worth) return false;
  shownAt_ = samples_;
  quick_ = false;
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
