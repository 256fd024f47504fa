// Light close to small sources: point and spot lamps, bulbs, globes. Within a voxel beside them illuminance varies as
// 1/d², and shadow rays to a few points miss its mean; and from afar such a voxel is small and very bright, so that a
// few links miss it or take it for too much. Particles sent out by the source do neither, and keep its flux.
#pragma once

#include <functional>
#include <vector>

#include "radiance/radiance_field.h"
#include "radiance/slot_light.h"
#include "radiance/slot_paths.h"
#include "radiance/slot_remap.h"
#include "trace/lights.h"

namespace roomlight {

// Where the light of a small source comes by particles rather than by shadow rays.
class LightSurroundings {
 public:
  LightSurroundings() = default;  // contain nothing
  LightSurroundings(const Lamp& lamp, float voxelSizeM);
  // Of an emissive mesh within `box`.
  LightSurroundings(const Bounds3& box, float voxelSizeM);
  bool contains(Vec3 p) const;
  // Whether it may contain anything of the box.
  bool touches(const Bounds3& box) const;
  // Holds all of it.
  Bounds3 bounds() const;
  // How many times as large it is as that of a point.
  float sizeOfPoints() const;

 private:
  Vec3 toSource(Vec3 p) const;
  float reachM() const { return std::max(near_, far_) + length(half_); }

  Vec3 position_, direction_{0, 0, 1}, acrossC0_{1, 0, 0}, acrossC90_{0, 1, 0};  // unit
  Vec3 half_;  // m; of an extended lamp's opening or the box, along acrossC0_, acrossC90_ and direction_
  float near_ = 0, far_ = 0;  // m: in all directions, and along a narrow spot
  float tanOuter_ = 0, voxelSizeM_ = 0;
};

// Of each emissive mesh; those of large ones contain nothing: they are no brighter than what shadow rays and gathering
// rays can deal with, for illuminance stays below pi times their luminance.
std::vector<LightSurroundings> emitterSurroundings(const Lights& lights, float voxelSizeM);
bool isSmall(const Lights& lights, size_t emitter, float voxelSizeM);

// What sends particles out: a lamp as if it had 1 cd in each channel, or an emissive mesh as it is.
struct ParticleSource {
  LightSurroundings around;
  uint64_t key;       // the same random numbers for a source whatever others there are
  float fluxLm;       // luminous
  size_t particles;
  void takeFewer();  // a part of them, for a first look
  bool isSurface;     // rays may find it: what polished metal reflects of it is left to them
  std::function<LightRay(Sampler&)> ray;  // with the flux of all, if it were the only one
};

// Of sources that share the particles: `lamps` are all of a scene, `emitters` its small emissive meshes.
ParticleSource particlesOf(const Lamp& lamp, size_t lamps, float voxelSizeM);
ParticleSource particlesOf(const Lights& lights, size_t emitter, size_t emitters, float voxelSizeM);

// Whether there is any surface in its surroundings: else it needs no particles.
bool hasSurfaces(const Voxels& voxels, const LightSurroundings& around);

// What some particles of a source left behind, and where they went. Each knows whose it is.
struct ParticleTrail {
  struct Deposit {
    Vec3 fluxLm;
    uint32_t slot;
    uint16_t particle;
    bool near;  // carried on
  };
  struct Point {
    GlowPoint glow;
    uint16_t particle;
  };
  struct Piece {
    Vec3 from, to;
    uint16_t particle;
    bool straight;  // else it keeps within the box of the two
  };
  std::vector<Deposit> deposits;
  std::vector<Point> points;
  std::vector<Piece> ways;
};

// What particles of one source leave behind.
struct ParticleLight {
  SlotLight near;  // lx; on slots in its surroundings: what they reflect of it is contained in `near` and `far`
  SlotLight far;  // lx; on other slots, by reflection in its surroundings or on surfaces that no slot stands for; and
                  // on polished metal
  std::vector<GlowPoint>
      points;  // of what surfaces in its surroundings reflect, about kPoints of them for all its flux
  std::vector<ParticleTrail> trails;  // kChunk particles each
  float fluxLm = 0;  // luminous, of the source
  uint64_t rays = 0;  // of the last trace
  bool few = false;  // not as many as the source asks for
  void scale(Vec3 by);  // the source shines otherwise
  size_t bytes() const;
};

constexpr float kGlowPoints = 32768;  // that stand for a flux like that of all sources

// Ends early, with a part of the light, once `progress` says stop.
ParticleLight traceParticles(const SlotSampling& slots, const ParticleSource& source, Attenuation attenuation,
                             const Progress& progress);

// Of lamps that are lit together, each as bright as it is: few particles of each. Points tell whose they are; there are
// no trails.
ParticleLight traceLampParticles(const SlotSampling& slots, const Lights& lights, Attenuation attenuation,
                                 const Progress& progress);

// After instances have moved, of the same source where it was: particles that came near the places of the change are
// traced again, and those that left something on slots that are gone.
void updateParticles(const SlotSampling& slots, const ParticleSource& source, Attenuation attenuation,
                     const SlotChange& change, const Progress& progress, ParticleLight& light);

}  // namespace roomlight
