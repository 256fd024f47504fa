#include "view/pacing.h"

#include <algorithm>
#include <cmath>

namespace roomlight::view {
namespace {

constexpr double kNewest = 0.4;       // weight of the newest measurement
constexpr int kNarrowest = 96;        // pixels: below that there is nothing to see
constexpr double kLineMs = 60;        // that a frame may be on its way
constexpr int kWorst = 50, kBest = 90;

}  // namespace

std::pair<int, int> Pace::sizeFor(double ms, std::pair<int, int> whole) const {
  const double pixels = static_cast<double>(whole.first) * whole.second;
  double scale = std::sqrt(std::min(1.0, ms / msPerMegapixel_ * 1e6 / pixels));
  scale = std::max(scale, std::min(1.0, static_cast<double>(kNarrowest) / std::min(whole.first, whole.second)));
  const auto scaled = [&](int edge) { return std::clamp(static_cast<int>(std::lround(edge * scale)), 1, edge); };
  return {scaled(whole.first), scaled(whole.second)};
}

void Pace::took(std::pair<int, int> size, double ms) {
  const double megapixels = static_cast<double>(size.first) * size.second / 1e6;
  if (megapixels <= 0) return;
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
  return static_cast<float>(std::clamp(std::sqrt(bytesPerMs_ * 2 * kLineMs / bytesAFrame_), 0.25, 1.0));
}

}  // namespace roomlight::view
