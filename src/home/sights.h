// What a camera sees of a scene, by some hundred rays.
#pragma once

#include <vector>

#include "trace/ray_scene.h"

namespace roomlight::home {

struct Seen {
  Vec3 p, n;  // n: towards the camera, unit
  float distanceM = 0;
};

struct Sights {
  std::vector<Seen> surfaces;
  size_t rays = 0;

  double share(float nearM, float farM) const;  // of the picture that shows surfaces as far away
};
Sights sightsOf(const RayScene& rays, const Camera& camera);

// Whether what the camera sees is mostly under roofs: in rooms, or closed in on all sides.
bool isIndoors(const RayScene& rays, const std::vector<Room>& rooms, const Camera& camera, const Sights& sights);

}  // namespace roomlight::home
