#include "radiance/sky_guide.h"

#include <algorithm>
#include <cmath>

namespace roomlight {
namespace {

constexpr int kCells = 255;  // along an edge

}  // namespace

SkyDirection::SkyDirection(Vec3 d) {
  const float scale = 1 / (std::abs(d.x) + std::abs(d.y) + std::abs(d.z));
  float u = d.x * scale, v = d.z * scale;
  if (d.y < 0) {
    const float folded = (1 - std::abs(v)) * (u < 0 ? -1.0f : 1.0f);
    v = (1 - std::abs(u)) * (v < 0 ? -1.0f : 1.0f), u = folded;
  }
  const auto cell = [](float x) {
    return static_cast<uint16_t>(std::clamp(static_cast<int>((0.5f * x + 0.5f) * kCells), 0, kCells - 1));
  };
  code_ = static_cast<uint16_t>(cell(u) | cell(v) << 8);
}

Vec3 SkyDirection::direction() const {
  if (code_ == kNone) return {};
  const auto middle = [](int cell) { return 2 * (static_cast<float>(cell) + 0.5f) / kCells - 1; };
  float u = middle(code_ & 0xff), v = middle(code_ >> 8);
  const float y = 1 - std::abs(u) - std::abs(v), under = std::max(0.0f, -y);
  u -= std::copysign(under, u), v -= std::copysign(under, v);
  return normalize(Vec3{u, y, v});
}

}  // namespace roomlight
