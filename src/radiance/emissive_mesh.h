// What the light of an emissive mesh hangs on, so that light traced for it is known again.
#pragma once

#include "trace/lights.h"

namespace roomlight {

struct EmissiveMesh {
  EmissiveMesh() = default;
  EmissiveMesh(const Scene& scene, uint32_t instance);

  uint32_t instance = 0;
  int mesh = -1, texture = -1;
  bool doubleSided = false;
  Affine place;
  Vec3 emission;  // cd/m², by which the texture's is scaled

  // Whether the light of `o` is this one's, scaled.
  bool shinesLike(const EmissiveMesh& o) const;
  bool operator==(const EmissiveMesh&) const = default;
};

// Per channel; 0 where neither shines.
Vec3 scaleBetween(Vec3 from, Vec3 to);

}  // namespace roomlight
