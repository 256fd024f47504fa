#include "scene/glazing.h"

#include <algorithm>
#include <cmath>

namespace roomlight {
namespace {

// A stack of panes, of which each has the interface reflectance r and lets a through inside.
GlazingLight stack(int panes, float r, float a) {
  const float t1 = (1 - r) * (1 - r) * a / (1 - r * r * a * a), r1 = r * (1 + a * t1);
  GlazingLight all{t1, r1};
  for (int i = 1; i < panes; ++i) {
    const float between = 1 / (1 - all.reflected * r1);
    all = {all.transmitted * t1 * between, all.reflected + all.transmitted * all.transmitted * r1 * between};
  }
  return all;
}

}  // namespace

GlazingLight glazingLight(const Glazing& glazing, float cosTheta) {
  const float c = std::clamp(cosTheta, 1e-4f, 1.0f), n = glazing.ior;
  const float ct = std::sqrt(1 - (1 - c * c) / (n * n));
  const float rs = (c - n * ct) / (c + n * ct), rp = (n * c - ct) / (n * c + ct);
  const float a = glazing.internalTransmittance >= 1 ? 1 : std::pow(glazing.internalTransmittance, 1 / ct);
  const GlazingLight s = stack(glazing.panes, rs * rs, a), p = stack(glazing.panes, rp * rp, a);
  return {0.5f * (s.transmitted + p.transmitted), 0.5f * (s.reflected + p.reflected)};
}

float glazingHemisphericalReflectance(const Glazing& glazing) {
  constexpr int kSteps = 128;
  float sum = 0;
  for (int i = 0; i < kSteps; ++i)
    sum += glazingLight(glazing, std::sqrt((static_cast<float>(i) + 0.5f) / kSteps)).reflected;  // even in cos²
  return sum / kSteps;
}

}  // namespace roomlight
