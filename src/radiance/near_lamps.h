// Light close to point and spot lamps. Within a voxel beside a lamp illuminance varies as 1/d², and shadow rays to a few points
// miss its mean; and from afar such a voxel is small and very bright, so that a few links miss it or take it for too much.
// Particles sent out by the lamp do neither, and keep its flux.
#pragma once

#include <vector>

#include "radiance/radiance_field.h"
#include "radiance/slot_light.h"
#include "radiance/slot_paths.h"

namespace roomlight {

// Where a lamp's light comes by particles rather than by shadow rays.
class LampSurroundings {
 public:
  LampSurroundings(const Lamp& lamp, float voxelSizeM);
  bool contains(Vec3 p) const;
  // Whether it may contain anything of the box.
  bool touches(const Bounds3& box) const;

 private:
  Vec3 toOpening(Vec3 p) const;

  Vec3 position_, direction_, acrossC0_, acrossC90_;  // unit
  float halfC0_ = 0, halfC90_ = 0;                    // m; of an extended lamp's opening
  float near_, far_;  // m: in all directions, and along a narrow spot
  float tanOuter_, voxelSizeM_;
};

// What particles of one lamp leave behind, for an intensity of 1 cd in each channel.
struct ParticleLight {
  SlotLight near;  // lx; on slots in its surroundings: what they reflect of it is contained in `near` and `far`
  SlotLight far;   // lx; on other slots, by reflection in its surroundings or on surfaces that no slot stands for
  std::vector<GlowPoint> points;  // of what surfaces in its surroundings reflect, about kPoints of them for all its flux
  Bounds3 way;     // of all particles
  float fluxPerCandela = 0;  // lm/cd, of the lamp
  uint64_t rays = 0;
};

constexpr float kGlowPoints = 32768;  // that stand for a flux like that of the lamps

// `particles`: how many a lamp gets where it has `lamps` beside it. Ends early, with a part of the light, once `progress` says stop.
ParticleLight traceParticles(const RayScene& rays, const Voxels& voxels, const SlotPaths& paths, const Lamp& lamp, size_t lamps,
                             const RadianceSettings& settings, const Progress& progress);

}  // namespace roomlight
