// What rays read where they arrive: the light that slots reflect, and whether a place is one that its slot stands for.
#pragma once

#include <vector>

#include "radiance/radiance_field.h"

namespace roomlight {

// How far the light of a slot can be taken for that of a place.
enum class Trust : uint8_t {
  None,    // no slot, or the place lies behind or before the slot's surface
  Unsure,  // other surfaces in the voxel may part the two: a ray between them tells
  Sure
};

class SlotCache {
 public:
  // Refers to both.
  SlotCache(const Voxels& voxels, const RadianceField& field);

  struct Place {
    int64_t slot = -1;
    Trust trust = Trust::None;
  };
  // For a point of a surface and its unit normal on the side that is looked at.
  Place find(Vec3 p, Vec3 n) const;
  // Reflected, as a Lambertian surface of the slot's albedo, cd/m².
  Vec3 radiance(int64_t slot) const { return radiance_[static_cast<size_t>(slot)]; }
  // Points between which a ray tells whether a slot stands for p, both a little before the surface.
  Ray between(int64_t slot, Vec3 p, Vec3 n) const;

 private:
  const Voxels& voxels_;
  std::vector<Vec3> radiance_;
};

}  // namespace roomlight
