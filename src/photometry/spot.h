// The fall-off of a spot lamp: full intensity inside the inner cone, none outside the outer one, between them the
// square of a ramp in the cosine, as KHR_lights_punctual recommends. Renderer and importer share it, so that lumens
// stay lumens.
#pragma once

#include <algorithm>

namespace roomlight {

// Narrowest ramp in the cosine, for cones that coincide. Above the rounding of float cosines, below what a narrow spot
// spans (1 - cos 0.5 degrees is 4e-5).
constexpr float kNarrowestSpotRamp = 1e-6f;

// Part of the intensity, 0 to 1, at an angle from the axis; all angles by their cosines.
inline float spotFalloff(float cosAngle, float cosInner, float cosOuter) {
  const float t = std::clamp((cosAngle - cosOuter) / std::max(kNarrowestSpotRamp, cosInner - cosOuter), 0.0f, 1.0f);
  return t * t;
}

// Integral of the fall-off over all directions in steradian: flux in lm / intensity in cd. For outer cones of at least
// 0.1 degrees, where the ramp fits in.
inline double spotFluxPerCandela(float cosInner, float cosOuter) {
  constexpr double kTwoPi = 6.283185307179586;
  const double ramp = std::max(kNarrowestSpotRamp, cosInner - cosOuter);
  return kTwoPi * ((1.0 - cosOuter - ramp) + ramp / 3);
}

}  // namespace roomlight
