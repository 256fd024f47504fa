// What the things of a scene measure: for checks against the home they were made from.
#pragma once

#include <string>
#include <vector>

#include "scene/scene.h"

namespace roomlight {

// All instances of one object that share a name together, in world space.
struct ObjectMeasures {
  std::string name;
  int object = 0;
  size_t triangles = 0;
  double areaUpM2 = 0, areaDownM2 = 0, areaUprightM2 = 0;  // by the fronts of triangles; upright: within 0.6 degrees
  // Without faces back to back: of every plane the area that looks to one side less that which looks to the other. So
  // bodies that are put together from parts measure as much as whole ones.
  double netAreaM2 = 0;
  double volumeM3 = 0;  // of a closed body whose fronts look outwards (divergence theorem); of others it says nothing
  Bounds3 bounds;

  double areaM2() const { return areaUpM2 + areaDownM2 + areaUprightM2; }
};

// Of all that have triangles, in the order in which the scene names them first.
std::vector<ObjectMeasures> measureObjects(const Scene& scene);

}  // namespace roomlight
