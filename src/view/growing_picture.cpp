#include "view/growing_picture.h"

#include "base/parallel.h"

namespace roomlight::view {
namespace {

constexpr uint32_t kMostAverages = 64, kBeforePaths = 24;
constexpr uint32_t kOneByOne = 4, kTogether = 4;
constexpr double kShowAgain = 1.4;  // times the samples of what was shown last
// The first average is shown with so many, or after so long: with fewer it would be noisier than the frame that reused
// light.
constexpr uint32_t kFirstShown = 4;
constexpr double kFirstShownS = 0.3;

}  // namespace

void GrowingPicture::showQuick(Image image, double pictureMs, bool reduced) {
  image_ = std::make_shared<const Image>(std::move(image));
  pictureMs_ = pictureMs, quick_ = reduced;
  sinceQuick_ = Stopwatch();
}

bool GrowingPicture::step(const LitScene& lit, const Camera& camera, std::pair<int, int> whole, Kind kind,
                          const std::atomic<bool>& newer) {
  const Stopwatch watch;
  // A few together cost less than one by one, but at first somebody waits.
  const uint32_t count = samples_ < kOneByOne ? 1 : kTogether;
  const Image next = lit.pictureOf(
      camera, {whole.first, whole.second, static_cast<int>(count), samples_, kind.white, true, nullptr}, {{}, &newer});
  if (newer || next.width == 0) return false;
  pictureMs_ = watch.seconds() * 1e3;
  if (samples_ == 0 || std::pair(sum_.width, sum_.height) != std::pair(next.width, next.height))
    sum_ = Image(next.width, next.height), samples_ = shownAt_ = 0;
  parallelFor(sum_.pixels.size(), 16384,
              [&](size_t i) { sum_.pixels[i] += next.pixels[i] * static_cast<float>(count); });
  samples_ += count;
  samplesInAll_ = kind.refines ? kBeforePaths : kMostAverages;
  averaged_ = samples_ >= samplesInAll_;
  settled_ = averaged_ && !kind.refines;
  const bool worth = shownAt_ == 0 ? samples_ >= kFirstShown || sinceQuick_.seconds() > kFirstShownS
                                   : samples_ >= kShowAgain * shownAt_;
  if (!averaged_ && !worth) return false;
  shownAt_ = samples_;
  quick_ = false;
  Image mean(sum_.width, sum_.height);
  const float share = 1 / static_cast<float>(samples_);
  parallelFor(mean.pixels.size(), 16384, [&](size_t i) { mean.pixels[i] = sum_.pixels[i] * share; });
  image_ = std::make_shared<const Image>(std::move(mean));
  return true;
}

void GrowingPicture::refine(Image image, uint32_t samples, float relativeError, bool last) {
  image_ = std::make_shared<const Image>(std::move(image));
  samples_ = samples, samplesInAll_ = 0, relativeError_ = relativeError;
  refined_ = true, settled_ = last;
}

}  // namespace roomlight::view
