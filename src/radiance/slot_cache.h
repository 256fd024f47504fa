// What rays read where they arrive: the light that slots reflect, and whether a place is one that its slot stands for.
#pragma once

#include <span>
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
  // Refers to the voxels.
  SlotCache(const Voxels& voxels, const RadianceField& field);

  struct Place {
    int64_t slot = -1;
    Trust trust = Trust::None;
  };
  // For a point of a surface and its unit normal on the side that is looked at.
  Place find(Vec3 p, Vec3 n) const;
  // Has what find() reads fetched into the processor's cache: what many points need comes at once, not one after the
// other.
  void prefetch(std::span<const Vec3> points) const;
  // Reflected, as a Lambertian surface of the slot's albedo, cd/m².
  Vec3 radiance(int64_t slot) const { return records_[static_cast<size_t>(slot)].radiance; }
  // The one that most of the slot's surface belongs to: what others have in its voxel may be of another albedo.
  uint32_t instance(int64_t slot) const { return records_[static_cast<size_t>(slot)].instance; }
  // A ray between p and the slot's place, both a little before their surface: where nothing is in its way the slot
// stands for p.
  Ray between(int64_t slot, Vec3 p, Vec3 n) const;

 private:
  // What is read of a slot, in half a cache line.
  struct alignas(32) Record {
    Vec3 radiance;
    float offset;                            // of its plane along the normal, in voxels from the lattice's origin
    int8_t normalX, normalY, normalZ;        // in 1/127
    bool alone;                              // in its voxel, but for the other side of its sheet
    uint32_t instance;
    Vec3 normal() const {
      return Vec3{static_cast<float>(normalX), static_cast<float>(normalY), static_cast<float>(normalZ)} * (1.0f / 127);
    }
  };
  int64_t slotOf(const SurfaceVoxel& voxel, Vec3 n) const;

  const Voxels& voxels_;
  float perMetre_;  // voxels
  std::vector<Record> records_;
};

}  // namespace roomlight
