#include "gather/quick_frames.h"

#include <algorithm>
#include <cmath>
#include <mutex>

#include "base/parallel.h"
#include "base/progress.h"
#include "gather/quick_maker.h"

namespace roomlight {
namespace {

constexpr size_t kTilesAtOnce = 4;
constexpr uint32_t kMostEvery = 16, kMostEveryOld = 64;
constexpr double kNewest = 0.3;        // weight of the newest measurement
constexpr size_t kMostNodes = 30'000;
constexpr float kSameUsual = 2;  // times: then nodes that were gathered by other usual light stay
constexpr float kLeastKnown = 0.25f;   // of what is seen: else the camera has jumped

// Of places at unit depth: pixels a unit of x and of y.
Vec2 pixelScaleOf(const Camera& camera, int width, int height) {
  const Vec3 d = inverse(camera.worldFromCamera).vector(CameraRays(camera, width, height).ray(0, 0).direction);
  return {std::abs(0.5f * static_cast<float>(width) * d.z / d.x),
          std::abs(0.5f * static_cast<float>(height) * d.z / d.y)};
}

}  // namespace

bool QuickFrames::Rules::isTurn(int x, int y, uint32_t frame, uint32_t every) {
  if (every <= 1) return every == 1;
  constexpr std::array<uint8_t, 16> kOrder{0, 8, 2, 10, 12, 4, 14, 6, 3, 11, 1, 9, 15, 7, 13, 5};
  const uint32_t order = kOrder[static_cast<size_t>((y & 3) * 4 + (x & 3))];
  if (every <= 16) return order % every == frame % every;
  const uint32_t block = static_cast<uint32_t>((x >> 2 & 1) + 2 * (y >> 2 & 1));
  return order + 16 * block == frame % 64 || (every == 32 && order + 16 * (block ^ 1) == frame % 64);
}

// Where the pixels of the frame before are in this one: the nearest of those that come to one pixel.
void QuickFrames::land(const Camera& camera) {
  const size_t pixels = now_.size();
  if (landed_.size() != pixels) landed_ = std::vector<std::atomic<uint64_t>>(pixels);
  const Affine toCamera = inverse(camera.worldFromCamera);
  const Vec2 scale = pixelScaleOf(camera, width_, height_);
  const float w = static_cast<float>(width_), h = static_cast<float>(height_);
  parallelFor(pixels, 16384, [&](size_t i) { landed_[i].store(Rules::kNothing, std::memory_order_relaxed); });
  parallelFor(past_.size(), 8192, [&](size_t i) {
    const Pixel& q = past_[i];
    if (q.state == kNone) return;
    const Vec3 c = q.key == Rules::kSky ? toCamera.vector(q.position) : toCamera.point(q.position);
    if (!(c.z < 0)) return;
    const float inverse = -1 / c.z, u = scale.x * c.x * inverse + 0.5f * w, v = 0.5f * h - scale.y * c.y * inverse;
    if (!(u >= 0 && v >= 0 && u < w && v < h)) return;
    std::atomic<uint64_t>& to = landed_[static_cast<size_t>(v) * static_cast<size_t>(width_) + static_cast<size_t>(u)];
    const float depth = q.key == Rules::kSky ? 1e30f : -c.z;
    const uint64_t mine = uint64_t{std::bit_cast<uint32_t>(depth)} << 32 | i;
    for (uint64_t there = to.load(std::memory_order_relaxed);
         mine < there && !to.compare_exchange_weak(there, mine, std::memory_order_relaxed);) {}
  });
}

// From what the frames before cost: as many are lit as there is time for.
void QuickFrames::planShares(double ms) {
  const size_t pixels = now_.size();
  const double threads = std::max(1, threadCount()), other = otherMs_[lands_] * static_cast<double>(pixels) / threads;
  const double budget = std::max(0.1 * ms, ms - other) * threads / msALight_;  // pixels
  const bool all = !hasPast_ || stale_ || changed_.lightsChanged();
  const size_t expected = all ? pixels : std::max<size_t>(count_.lit, pixels / 50);
  everyNew_ = 1;
  while (everyNew_ < kMostEvery && budget * everyNew_ < static_cast<double>(expected)) everyNew_ *= 2;
  // Once all else is done.
  const double rest = all ? budget : budget - static_cast<double>(hasPast_ && expected > pixels / 50 ? expected : 0);
  everyOld_ = all ? kMostEvery : kMostEveryOld;
  const double lent = all ? static_cast<double>(pixels) : static_cast<double>(count_.lent + count_.kept / 8);
  while (everyOld_ > 1 && lent / (everyOld_ / 2) < rest) everyOld_ /= 2;
}

// A camera that has jumped sees little of what the frame before saw, or sees it from a quite different side, with other
// reflections: nothing of that frame counts.
void QuickFrames::surveyPast(const Maker& maker, const Camera& camera) {
  const Maker::Survey seen = maker.survey();
  usualLux_ = seen.usualLux;
  forgetNodes();
  if (!hasPast_) return;
  const float moved = length(camera.worldFromCamera.w - camera_->worldFromCamera.w);
  if (seen.known >= kLeastKnown && !hasJumped(moved, seen.distanceM)) return;
  hasPast_ = false;
  past_.clear();
}

// Beyond a number of them, and where the usual light is another: what nodes take for dark or for an outlier goes by it.
void QuickFrames::forgetNodes() {
  const float more = std::max(usualLux_, nodesLux_), less = std::min(usualLux_, nodesLux_);
  if (more <= kSameUsual * less && nodes_->nodes() <= kMostNodes) return;
  nodes_->forget();
  nodesLux_ = usualLux_;
}

Image QuickFrames::make(const QuickScene& scene, const Camera& camera, int width, int height, double ms,
                        const Progress& progress) {
  const size_t pixels = static_cast<size_t>(width) * static_cast<size_t>(height);
  const bool still = camera_ && width == width_ && height == height_ && seeTheSame(*camera_, camera);
  hasPast_ = camera_ && camera_->cutHeightM == camera.cutHeightM;  // else pixels are of what is cut away
  if (camera_) {
    fromWorld_ = inverse(camera_->worldFromCamera);
    pixelScale_ = pixelScaleOf(*camera_, width_, height_);
  }
  past_.swap(now_);
  pastWidth_ = width_, pastHeight_ = height_;
  width_ = width, height_ = height;
  now_.resize(pixels);
  if (!hasPast_) past_.clear();
  changed_.lightBy(scene.lights, scene.light.sharpEmissive());
  Maker maker(*this, scene, camera, width, height);
  if (!still || stale_ || changed_.any()) surveyPast(maker, camera);
  // Where the scene has changed every pixel looks for itself.
  lands_ = hasPast_ && !stale_ && !changed_.any();
  planShares(ms);
  camera_ = camera;
  const Stopwatch landing;
  if (lands_) land(camera);
  const double landedMs = landing.seconds() * 1e3 * std::max(1, threadCount());

  Image out(width, height);
  const size_t across = static_cast<size_t>((width + Rules::kTile - 1) / Rules::kTile),
               tiles = across * static_cast<size_t>((height + Rules::kTile - 1) / Rules::kTile);
  Count sum;
  std::mutex adding;
  parallelRanges(tiles, kTilesAtOnce, [&](size_t begin, size_t end) {
    Count count;
    for (size_t tile = begin; tile < end && !progress.stop(); ++tile)
      maker.make(static_cast<int>(tile % across) * Rules::kTile, static_cast<int>(tile / across) * Rules::kTile, count,
                 out);
    const std::lock_guard lock(adding);
    sum.kept += count.kept, sum.traced += count.traced, sum.lit += count.lit, sum.lent += count.lent,
        sum.otherMs += count.otherMs, sum.litMs += count.litMs;
  });
  if (progress.stop()) {
    forget();
    return {};
  }
  sum.otherMs += landedMs;
  sum.leastLight = everyNew_ == kMostEvery && everyOld_ >= kMostEvery;
  count_ = sum;
  double& other = otherMs_[lands_];
  const double otherNow = sum.otherMs / static_cast<double>(pixels);
  other = other > 0 ? other + kNewest * (otherNow - other) : otherNow;
  if (sum.lit > 1000) msALight_ += kNewest * (sum.litMs / static_cast<double>(sum.lit) - msALight_);
  settled_ = still && sum.lent == 0 && sum.lit == 0;
  stale_ = false;
  changed_.forget();
  ++frame_;
  return out;
}

void QuickFrames::sceneChanged(const SceneChange& change, const Scene& scene) {
  nodes_->forget(change.moved);
  changed_.add(change, scene, [&](std::vector<Bounds3>& seen) {
    for (const Pixel& q : now_) {
      if (q.key < seen.size()) seen[q.key].add(q.position);
    }
  });
}

void QuickFrames::adopt(const Image& better) {
  if (!camera_ || better.pixels.empty() || now_.empty()) return;
  parallelFor(static_cast<size_t>(height_), 16, [&](size_t y) {
    const int row = static_cast<int>(y) * better.height / height_;
    for (int x = 0; x < width_; ++x) {
      Pixel& q = now_[y * static_cast<size_t>(width_) + static_cast<size_t>(x)];
      if (q.state != kNone) q.colour = better.at(x * better.width / width_, row), q.state = kFine;
    }
  });
}

}  // namespace roomlight
