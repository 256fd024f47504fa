// Light close to point and spot lamps. Within a voxel beside a lamp illuminance varies as 1/d², and shadow rays to a few points
// miss its mean; and from afar such a voxel is small and very bright, so that a few links miss it or take it for too much.
// Particles sent out by the lamp do neither, and keep its flux.
#pragma once

#include <vector>

#include "radiance/radiance_field.h"
#include "radiance/slot_paths.h"

namespace roomlight {

class NearLamps {
 public:
  NearLamps(const Lights& lights, const Voxels& voxels);

  // Whether the slot's light from that lamp comes by particles rather than by shadow rays.
  bool isNear(size_t lamp, size_t slot) const;

  // Illuminance per slot in lx, per channel.
  struct Light {
    std::vector<Vec3> near;  // on slots near lamps; what they reflect of it is contained in `near` and `far`. Empty: none
    std::vector<Vec3> far;   // on other slots, by reflection near lamps or on surfaces that no slot stands for
    // Share of what a slot reflects of `near` that a cone may see, 0..1: in a cavity narrower than voxels, which cones look into
    // from everywhere, no more than really comes out.
    std::vector<float> shown;
    uint64_t rays = 0;
  };
  Light trace(const RayScene& rays, const SlotPaths& paths, const RadianceSettings& settings) const;

 private:
  struct Deposit {
    uint32_t slot;
    Vec3 fluxLm;
    float reflectedLm = 0, escapedLm = 0;  // further than to other slots near lamps
  };
  void follow(const RayScene& rays, const SlotPaths& paths, size_t lamp, Ray ray, Hit hit, Vec3 fluxLm, Attenuation attenuation,
              Sampler& sampler, std::vector<Deposit>& deposits) const;
  float litArea(const FaceSlot& slot) const;

  const Lights& lights_;
  const Voxels& voxels_;
  std::vector<uint8_t> nearAny_;   // per slot
  std::vector<size_t> lamps_;      // those with slots near them
};

}  // namespace roomlight
