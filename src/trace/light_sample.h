// One way light may reach a point, before visibility.
#pragma once

#include <cstdint>

#include "base/vec.h"

namespace roomlight {

struct LightSample {
  Vec3 wi;            // unit, towards the light
  float distance = kInfinity;
  Vec3 radiance;  // incident radiance / pdf: times f cos is the estimate. Delta lights: intensity / distance² / chance
  float pdf = 0;  // per steradian, selection included; 0: delta light, no other strategy can find it
  int32_t lamp = -1;  // of which point or spot lamp (see Lights), -1: none
  int32_t emitter = -1;  // of which emissive mesh, -1: none
  bool valid() const { return !isBlack(radiance); }
};

}  // namespace roomlight
