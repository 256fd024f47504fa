// Light of technique `vxgi` that is kept up to date: voxels and direct light that a change has nothing to do with stay,
// and bounces go on from the light there was.
#pragma once

#include <memory>
#include <vector>

#include "baselines/vxgi.h"
#include "baselines/vxgi_sources.h"
#include "radiance/light_cache.h"
#include "scene/scene_change.h"
#include "voxel/voxelise.h"

namespace roomlight {

class VxgiCache {
 public:
  // `room` is what the finest level shall hold. Once `progress` says stop it ends soon, with part of the light.
  VxgiCache(const RayScene& rays, const Lights& lights, const Bounds3& room, const VxgiSettings& settings,
            const Progress& progress = {});

  // `rays` and `lights` are of the scene as it is now; suns and sky are as before.
  void update(const RayScene& rays, const Lights& lights, const SceneChange& change, const Progress& progress = {});
  // Whether bounces have come to their end; if not, update() goes on with them.
  bool settled() const { return settled_; }

  const VxgiLight& light() const { return light_; }
  VxgiLight take() { return std::move(light_); }

 private:
  struct Level {
    Level(const RayScene& rays, const Lights& lights, const VoxelSettings& voxel, const RadianceSettings& radiance,
          const Progress& progress)
        : voxelisation(voxelise(rays.scene(), voxel)), direct(rays, lights, voxelisation.voxels, radiance, progress) {}
    Voxelisation voxelisation;
    LightCache direct;
  };
  void gatherSources(const RayScene& rays);
  void bounce(int most, const Progress& progress);

  VxgiSettings settings_;
  std::vector<std::unique_ptr<Level>> levels_;  // the finest first
  VxgiSources sources_;
  bool settled_ = true;
  VxgiLight light_;
};

}  // namespace roomlight
