#include "validate/cases.h"

#include <fmt/format.h>

namespace roomlight {

Quantity reading(const std::string& place, const SurfaceElement& element, double scale, double expected) {
  return {place, {element}, {scale}, 0, expected};
}

SurfaceElement wallPoint(int i, float y) {
  return {cie(2, y, 2.75f - 0.5f * static_cast<float>(i)), cie(0, y > 0 ? -1.0f : 1.0f, 0)};
}
SurfaceElement floorPoint(int i) { return {cie(2, 0.25f + 0.5f * static_cast<float>(i), 0), {0, 1, 0}}; }
std::string wallName(int i) { return fmt::format("wall {}, {:.2f} m up", "ABCDEF"[i], 2.75 - 0.5 * i); }
std::string floorName(int i) { return fmt::format("floor {}, {:.2f} m in", "GHJKLMNP"[i], 0.25 + 0.5 * i); }

}  // namespace roomlight
