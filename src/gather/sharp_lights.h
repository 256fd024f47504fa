// Suns and lamps: small sources with sharp shadows. Every camera ray asks for its own shadow, in packets, because a
// shadow's edge crosses a pixel as the edge of a thing does.
#pragma once

#include <span>

#include "base/sampler.h"
#include "trace/lights.h"
#include "trace/ray_scene.h"

namespace roomlight {

// What arrives of a source's light, as a mean over points; the variance is of its luminance as a mean.
struct Shadow {
  Vec3 left;
  float variance = 0;
};

class SharpLights {
 public:
  static constexpr size_t kMostPoints = 8;

  SharpLights(const RayScene& rays, const Lights& lights);
  size_t count() const { return lamps_ + lights_.sunCount(); }
  LightSample sample(size_t light, Vec3 p, Vec2 u) const;
  // `points` lie clear of their surface; `u` as many places on the source.
  Shadow shadow(size_t light, std::span<const Vec3> points, std::span<const Vec2> u) const;

 private:
  const RayScene& rays_;
  const Lights& lights_;
  size_t lamps_;  // 0 where they are so many that a few have to be chosen by importance, or where one is extended: its
                  // shadows are not
};

// What a ray sees that meets no surface, cd/m².
Vec3 background(const Lights& lights, Vec3 direction);
Vec3 skyAlong(const Lights& lights, Vec3 direction);  // without suns

}  // namespace roomlight
