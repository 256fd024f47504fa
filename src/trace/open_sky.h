// Where a light meter sees the sky: found by a few rays, and then sampled there. A window that fills a hundredth of the
// sky is hit by every ray instead of by every hundredth.
#pragma once

#include <array>
#include <cstdint>

#include "base/random.h"
#include "trace/lights.h"
#include "trace/ray_scene.h"

namespace roomlight {

struct SurfaceElement;

class OpenSky {
 public:
  // Sends a ray into each of kCells parts of the hemisphere over the element that count alike for illuminance, and more
  // around those that see the sky.
  OpenSky(const RayScene& rays, const Lights& lights, const SurfaceElement& element, uint64_t seed);

  // Whether there is a sky at all.
  bool present() const { return present_; }
  // A direction above the element in which the sky is probably seen. `radiance` is divided by the density, which is
  // above zero wherever the element can see.
  LightSample sample(Vec2 u) const;

 private:
  static constexpr int kAround = 32, kUp = 16, kCells = kAround * kUp;
  Vec3 direction(int cell, Vec2 u) const;
  template <class Body>
  static void forAround(int cell, Body&& body);
  std::array<float, kCells> look(const RayScene& rays, Vec3 origin, uint64_t seed) const;

  const Lights& lights_;
  Frame frame_;
  bool present_;
  std::array<float, kCells> upTo_;  // sums of chances
};

}  // namespace roomlight
