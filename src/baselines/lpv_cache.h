// Light of technique `lpv` that is kept up to date. Maps, injection and propagation are done anew, as in every frame of
// that method; what stays of things that do not move are the voxels that its surfels come from, and what these get from
// the sky.
#pragma once

#include <vector>

#include "baselines/lpv.h"
#include "radiance/slot_remap.h"
#include "radiance/sky_guide.h"
#include "scene/scene_change.h"
#include "voxel/voxelise.h"

namespace roomlight {

class LpvCache {
 public:
  // `room` is what the fine grid shall hold. Once `progress` says stop it ends soon, with part of the light.
  LpvCache(const RayScene& rays, const Lights& lights, const Bounds3& room, const LpvSettings& settings,
           const Progress& progress = {});

  // `rays` and `lights` are of the scene as it is now; suns and sky are as before.
  void update(const RayScene& rays, const Lights& lights, const SceneChange& change, const Progress& progress = {});
  bool settled() const { return true; }

  const LpvLight& light() const { return light_; }
  LpvLight take();

 private:
  // Of a side of a voxel: what it reflects of the sky, and where its rays went.
  struct UnderSky {
    Vec3 fluxLm;
    std::vector<SkyDirection> ways;
  };
  void followVoxels(const RayScene& rays, const Lights& lights, const SlotRemap& remap, std::span<const Bounds3> places,
                    const Progress& progress);
  UnderSky askSky(const RayScene& rays, const Lights& lights, size_t slot) const;
  void light(const RayScene& rays, const Lights& lights, const Progress& progress);

  LpvSettings settings_;
  Bounds3 room_, home_;
  LpvLattice fine_;
  Voxelisation voxels_;
  std::vector<BrickMark> marks_;
  std::vector<uint8_t> shown_;  // per slot
  std::vector<UnderSky> underSky_;  // per slot; empty: no sky
  LpvLight light_;
};

}  // namespace roomlight
