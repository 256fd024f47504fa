// Light that reaches slots straight from lamps, emissive meshes, suns and the sky, by shadow rays through panes.
#pragma once

#include <atomic>
#include <span>

#include "radiance/brick_importance.h"
#include "radiance/links.h"
#include "radiance/near_lights.h"
#include "radiance/radiance_field.h"
#include "radiance/sky_guide.h"
#include "radiance/slot_paths.h"

namespace roomlight {

// What part of direct light, traced brick by brick.
class DirectLight {
 public:
  DirectLight(const RayScene& rays, const Lights& lights, const SlotSampling& slots, const SeenLights& seen,
              const BrickImportance& importance, const RadianceSettings& settings)
      : rays_(rays),
        lights_(lights),
        slots_(slots),
        voxels_(slots.voxels),
        paths_(slots.paths),
        seen_(seen),
        importance_(importance),
        settings_(settings),
        besideEmitters_(emitterSurroundings(lights, slots.voxels.voxelSizeM)) {}

  // Illuminance in lx per channel of the slots of one brick, in one value per slot of the scene. Of a lamp for 1 cd. Of
  // lamps and emissive meshes less what their particles carry. Where `near` boxes are given only slots some of whose
  // rays may cross one of them, and those beside them whose rays depend on that, get another value: the same as if all
  // were traced.
  void lamp(const Lamp& lamp, size_t brick, std::span<const Bounds3> near, std::span<Vec3> lux);
  // Of all lamps as one light, as bright as they are: fewer rays than one by one. `around`: surroundings of each.
  void lamps(std::span<const LightSurroundings> around, size_t brick, std::span<Vec3> lux);
  void suns(size_t brick, std::span<const Bounds3> near, std::span<Vec3> lux);
  // `ways`: of its slots, written where all is traced and read where only what boxes concern is.
  void sky(const SkyGuide& guide, size_t brick, std::span<const Bounds3> near, SkyDirections& ways,
           std::span<Vec3> lux);
  // All of it, shared with links: what single samples seldom find, but then far too much of, they know (multiple
  // importance sampling, Veach 1997). `guide.others`: by it they share; a brick's own links must not decide on it, or
  // those that find light would count for less.
  struct SharedSky {
    const SkyGuide &own, &others;
    const Links& links;
  };
  void skyWithLinks(const SharedSky& guide, size_t brick, std::span<Vec3> lux);
  // Of one emissive mesh alone, and of all as one light: fewer rays than one by one.
  void emitter(size_t index, size_t brick, std::span<const Bounds3> near, std::span<Vec3> lux);
  void emitters(size_t brick, std::span<const Bounds3> near, std::span<Vec3> lux);

  uint64_t rayCount() const { return count_; }

 private:
  struct Samples {
    uint32_t first,
        most;  // per slot: to begin with, and where the first and those of its neighbours do not agree on shadows
  };
  struct Segment;
  enum Mark : uint8_t { kAsItIs, kShadowOnly, kAnew };
  using Marks = std::vector<Mark>;  // per slot of a brick
  template <class SegmentOf>
  void findCrossed(size_t brick, uint32_t samples, std::span<const Bounds3> near, float off, const SegmentOf& segmentOf,
                   Marks& out) const;
  void markAround(size_t brick, Marks& marks) const;
  template <class Sample>
  static auto ways(const Sample& sample);
  bool mayCross(size_t brick, const Bounds3& source, std::span<const Bounds3> near) const;
  bool mayCrossFromAfar(size_t brick, const Bounds3& directions, std::span<const Bounds3> near) const;
  Bounds3 whereSlotsLie(size_t brick) const;
  Samples samplesOf(const Bounds3& source, const Bounds3& slots) const;
  void clear(size_t brick, const Marks& marks, std::span<Vec3> lux) const;
  template <class Sample>
  void trace(size_t brick, Samples samples, const Marks& marks, std::span<Vec3> lux, const Sample& sample);
  template <class FindMarks, class Sample>
  void renew(size_t brick, Samples samples, std::span<const Bounds3> near, std::span<Vec3> lux,
             const FindMarks& findMarks, const Sample& sample);
  LightSample skySample(const SkyGuide& guide, int32_t which, size_t s, uint32_t k) const;
  void keepWays(const SkyGuide& guide, size_t brick, SkyDirections& ways) const;
  uint32_t perDelta() const {
    return static_cast<uint32_t>(std::clamp(settings_.directSamples / 2, 1, 4));
  }  // of a lamp or sun
  Vec3 point(size_t slot, uint32_t k) const { return paths_.point(slot, k + paths_.key(slot)); }

  const RayScene& rays_;
  const Lights& lights_;
  const SlotSampling slots_;
  const Voxels& voxels_;
  const SlotPaths& paths_;
  const SeenLights& seen_;
  const BrickImportance& importance_;
  const RadianceSettings& settings_;
  const std::vector<LightSurroundings> besideEmitters_;
  std::atomic<uint64_t> count_ = 0;
};

}  // namespace roomlight
