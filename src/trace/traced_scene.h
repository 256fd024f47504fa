// What every stage that follows light needs: the scene's surfaces and its lights, and rays between them.
#pragma once

#include <algorithm>

#include "trace/lights.h"
#include "trace/ray_scene.h"

namespace roomlight {

// Refers to both.
struct TracedScene {
  const RayScene& rays;
  const Lights& lights;
};

// A ray from a surface to where light is sampled: towards a sample that was taken at p. `from` is p or lies just clear
// of its surface: the ray ends before the very point of the light all the same, and so does not meet the light's own
// surface, however near that is.
inline Ray shadowRay(Vec3 from, Vec3 p, const LightSample& light) {
  if (!(light.distance < kInfinity)) return {from, light.wi, 0, kInfinity};
  constexpr float kShort = 1e-4f,
                  kShortOfScale = 3e-5f;  // of the way; of coordinates, three times what points are lifted by
  const Vec3 to = p + light.wi * light.distance, way = to - from;
  const float scale = std::max({1.0f, maxComponent(abs(to)), maxComponent(abs(from))});
  const float l = length(way);
  return {from, way / std::max(l, 1e-12f), 0, std::max(0.0f, l - std::max(kShort * l, kShortOfScale * scale))};
}

}  // namespace roomlight
