// Shadow rays that tell what part of the light that lights could give arrives.
#pragma once

#include <algorithm>
#include <vector>

#include "base/vec.h"
#include "trace/lamp_light.h"
#include "trace/ray_scene.h"
#include "trace/traced_scene.h"

namespace roomlight {

// Of one light or group: what looks at it could have found without shadows, and what they found.
struct LightLook {
  static constexpr float kFloor = 0.03f;    // a light that no ray found gives that part of what it could
  static constexpr float kUntried = 0.25f;  // and one that no ray looked for
  float asked = 0, found = 0;
  void add(float a, float f) { asked += a, found += f; }
  float part() const { return asked > 0 ? std::max(found / asked, kFloor) : kUntried; }
};

// Traced together.
class LightLooks {
 public:
  // A light sample of `light`, which could give `could` at p by what it is chosen by, and was chosen with a chance.
// `n`: unit normal there. Dark samples need no ray.
  void add(uint32_t light, float could, const LightSample& sample, Vec3 p, Vec3 n, float chance = 1) {
    Look& look = looks_.emplace_back(Look{light, could / chance, 0, -1});
    const float cosine = dot(sample.wi, n);
    if (!sample.valid() || cosine <= 0) return;
    look.found = luminance(sample.radiance) * cosine / chance, look.ray = static_cast<int32_t>(ways_.size());
    ways_.push_back(shadowRay(p, p, sample));
  }
  // Calls take(light, asked, found) for each, in order; returns how many rays that took. Nothing is left.
  template <class Take>
  size_t finish(const RayScene& rays, const Take& take) {
    left_.resize(ways_.size());
    rays.transmittance(ways_, left_);
    for (const Look& l : looks_)
      take(l.light, l.asked, l.ray < 0 ? 0 : l.found * luminance(left_[static_cast<size_t>(l.ray)]));
    looks_.clear(), ways_.clear();
    return left_.size();
  }

 private:
  struct Look {
    uint32_t light;
    float asked, found;
    int32_t ray;  // -1: none
  };
  std::vector<Look> looks_;
  std::vector<Ray> ways_;
  std::vector<Vec3> left_;
};

}  // namespace roomlight
