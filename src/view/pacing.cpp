#include "view/pacing.h"

#include <algorithm>
#include <cmath>

namespace roomlight::view {
namespace {

constexpr double kNewest = 0.4;       // weight of the newest measurement
constexpr int kNarrowest = 96;        // pixels: below that there is nothing to see
constexpr double kMostPixels = 960 * 540;
constexpr double kRoom = 0.8;         // of the time asked for: sizes grow below it, and shrink above its inverse
constexpr int kBeforeGrowing = 8;     // frames
constexpr double kLineMs = 60;        // that a frame may be on its way
constexpr int kWorst = 50, kBest = 90;
constexpr double kStepOctaves = 0.25;  // between sizes, of the edges
constexpr int kMostLineSteps = 8;

double scaleOf(int step) { return std::exp2(-kStepOctaves * step); }

}  // namespace

std::pair<int, int> Pace::sizeFor(double ms, std::pair<int, int> whole) {
  const double pixels = static_cast<double>(whole.first) * whole.second;
  const auto pixelsAt = [&](int step) { return pixels * scaleOf(step) * scaleOf(step); };
  const auto cost = [&](int step) { return msPerMegapixel_ * pixelsAt(step) / 1e6; };
  const auto mayShrink = [&](int step) {
    return std::min(whole.first, whole.second) * scaleOf(step + 1) >= kNarrowest;
  };
  const int before = step_;
  while (step_ > 0 && measured_ >= kBeforeGrowing && cost(step_ - 1) < kRoom * ms) --step_;
  while ((cost(step_) > ms / kRoom || pixelsAt(step_) > kMostPixels) && mayShrink(step_)) ++step_;
  while (step_ > 0 && !mayShrink(step_ - 1)) --step_;
  if (step_ != before) measured_ = 0;
  const auto scaled = [&](int edge) {
    return std::clamp(static_cast<int>(std::lround(edge * scaleOf(step_))), 1, edge);
  };
  return {scaled(whole.first), scaled(whole.second)};
}

void Pace::took(std::pair<int, int> size, double ms) {
  const double megapixels = static_cast<double>(size.first) * size.second / 1e6;
  if (megapixels <= 0) return;
  ++measured_;
  msPerMegapixel_ += kNewest * (std::max(ms, 0.1) / megapixels - msPerMegapixel_);
}

void Line::sent(size_t bytes, double ms) {
  bytesPerMs_ += kNewest * (static_cast<double>(bytes) / std::max(ms, 0.5) - bytesPerMs_);
  bytesAFrame_ += kNewest * (static_cast<double>(bytes) - bytesAFrame_);
}

int Line::quality() const {
  if (bytesAFrame_ <= 0) return 80;
  // Bytes grow about as the square of quality does.
  const double room = bytesPerMs_ * kLineMs / bytesAFrame_;
  return std::clamp(static_cast<int>(80 * std::sqrt(room)), kWorst, kBest);
}

float Line::scale() const {
  if (bytesAFrame_ <= 0 || quality() > kWorst) return 1;
  const double fits = std::sqrt(bytesPerMs_ * 2 * kLineMs / bytesAFrame_);
  return static_cast<float>(
      scaleOf(std::clamp(static_cast<int>(std::ceil(-std::log2(fits) / kStepOctaves)), 0, kMostLineSteps)));
}

}  // namespace roomlight::view
