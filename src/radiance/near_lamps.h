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
  NearLamps(const Lights& lights, const Voxels& voxels, const SlotPaths& paths);

  // Whether the slot's light from that lamp comes by particles rather than by shadow rays.
  bool isNear(size_t lamp, size_t slot) const { return isNear(lamp, voxels_.slots[slot].position); }

  // Illuminance per slot in lx, per channel.
  struct Light {
    std::vector<Vec3> near;  // on slots near lamps; what they reflect of it is contained in `near` and `far`. Empty: none
    std::vector<Vec3> far;   // on other slots, by reflection near lamps or on surfaces that no slot stands for
    std::vector<GlowPoint> points;  // of what surfaces near lamps reflect; radiance is for the caller to fill in
    uint64_t rays = 0;
  };
  // Ends early, with a part of the light, once `progress` says stop.
  Light trace(const RayScene& rays, const SlotPaths& paths, const RadianceSettings& settings, const Progress& progress) const;

 private:
  struct Deposit {
    uint32_t slot;
    Vec3 fluxLm;
  };
  // What particles leave behind.
  struct Trail {
    std::vector<Deposit> deposits;
    std::vector<GlowPoint> points;
  };
  void follow(const RayScene& rays, const SlotPaths& paths, size_t lamp, Ray ray, Hit hit, Vec3 fluxLm, float pointLm, Attenuation attenuation,
              Sampler& sampler, Trail& trail) const;
  float radius() const;  // within which a lamp is near
  bool isNear(size_t lamp, Vec3 p) const;
  float narrowFor(const Lamp& lamp) const;
  bool isNearAny(const HiddenReflection& h, size_t lamp) const { return h.slot >= 0 ? nearAny_[static_cast<size_t>(h.slot)] != 0 : isNear(lamp, h.p); }
  float litArea(const FaceSlot& slot) const;

  const Lights& lights_;
  const Voxels& voxels_;
  std::vector<uint8_t> nearAny_;   // per slot
  std::vector<size_t> lamps_;      // those with slots near them
};

}  // namespace roomlight
