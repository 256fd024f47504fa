// What reflects light in technique `vxgi`: the voxels of its clipmap's levels that surfaces are in.
#pragma once

#include <vector>

#include "baselines/vxgi_clipmap.h"
#include "trace/ray_scene.h"

namespace roomlight {

// One side of the surfaces in a voxel.
struct VxgiSide {
  static constexpr float kUnknown = -1;
  Vec3 p, n, albedo;
  Vec3 directLux, indirectLux;
  float areaM2 = 0;
  float open = kUnknown;  // share of directions in which nothing is met
  int face = 0;
  bool front = true;
  Vec3 radiance() const { return albedo * (directLux + indirectLux) / kPi; }
};

// A voxel that surfaces are in, on the level where it is not made of finer ones.
struct VxgiSource {
  int level;
  Int3 v;  // from the level's corner
  Vec3 opacity;
  size_t first, count;  // sides
};

struct VxgiSources {
  std::vector<VxgiSource> voxels;
  std::vector<VxgiSide> sides;
};

// The voxels of one level that are its own. `directLux`: per slot.
void addSources(const RayScene& rays, const VxgiClipmap& map, int level, const Voxels& voxels,
                const std::vector<Vec3>& directLux, VxgiSources& out);
// What `before` knows of sides that are as they were: indirect light and openness.
void carrySides(const VxgiSources& before, VxgiSources& now);
// Where it is not known.
void findOpenness(const RayScene& rays, VxgiSources& sources);
// All levels from their sources.
void inject(const VxgiSources& sources, VxgiClipmap& map);
double reflectedLight(const VxgiSources& sources);

}  // namespace roomlight
