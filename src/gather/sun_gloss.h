// How sunlit places reflect the sun towards a viewer, beside a Lambertian surface of the same albedo. Points of sunlit
// patches (BrightPatches) have Lambertian flux; a floor's gloss throws several times as much towards the wall on which
// the sun glints.
#pragma once

#include <vector>

#include "radiance/bright_patches.h"
#include "trace/surface_point.h"

namespace roomlight {

class SunGloss {
 public:
  SunGloss() = default;
  // Materials of the points that the sun lights. `toSun`: unit.
  SunGloss(const RayScene& rays, const Voxels& voxels, const BrightPatches& patches, Vec3 toSun);
  // What a sunlit surface reflects towards `wo`, of an illuminance of 1 lx on a plane with normal `n`, in cd/m²: with
  // gloss, less what it would without. `s.m.roughness` is at least kSpread.
  static Vec3 bend(const SurfacePoint& s, Vec3 n, Vec3 toSun, Vec3 wo);
  // Times the point's Lambertian light, towards wo: 1 of points that no sun lights. Never negative.
  Vec3 at(size_t point, Vec3 wo) const;
  size_t bytes() const { return surfaces_.size() * sizeof(surfaces_[0]) + surfaceOf_.size() * sizeof(surfaceOf_[0]); }

 private:
  struct Surface {
    SurfacePoint s;  // with at least that roughness; no material: none was found
    Vec3 even, scale;  // what bend() takes away, and what makes it a part of Lambertian light
    float cosSun;
  };
  std::vector<Surface> surfaces_;  // of slots
  std::vector<int32_t> surfaceOf_;  // of each point; -1: none
  Vec3 toSun_;
};

}  // namespace roomlight
