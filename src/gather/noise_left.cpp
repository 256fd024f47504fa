#include "gather/noise_left.h"

#include <algorithm>
#include <cmath>

namespace roomlight {
namespace {

constexpr double kDarkest = 0.05;  // of the mean luminance: below it noise counts as absolute

}  // namespace

double noiseLeft(const FilteredLuminance& left, std::span<const uint32_t> raysThen, std::span<const uint32_t> raysNow) {
  const size_t count = left.luminance.size();
  if (count == 0) return -1;
  double sum = 0, relative = 0;
  for (const float l : left.luminance) sum += static_cast<double>(l);
  const double darkest = kDarkest * sum / static_cast<double>(count) + 1e-20;
  for (size_t i = 0; i < count; ++i) {
    const double then = std::max(1u, raysThen[i]), now = std::max(1u, raysNow[i]), level = std::max(0.0, static_cast<double>(left.luminance[i])) + darkest;
    relative += static_cast<double>(left.variance[i]) * std::min(1.0, then / now) / (level * level);
  }
  return std::sqrt(relative / static_cast<double>(count));
}

}  // namespace roomlight
