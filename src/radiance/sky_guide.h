// Sampling the sky through windows: directions that other rays from the same brick found open.
#pragma once

#include "radiance/radiance_field.h"

namespace roomlight {

// Builds the guide from the links that left the scene: `escaped` calls back for every slot with (direction, weight) pairs.
class SkyGuideBuilder {
 public:
  explicit SkyGuideBuilder(const Voxels& voxels);
  void add(size_t brick, Vec3 direction, float weight);  // one thread a brick
  SkyGuide finish(const Voxels& voxels);

 private:
  std::vector<std::array<float, kGuideSize * kGuideSize>> histograms_;
};

// A sky direction for a surface point in `brick` (an index into Voxels::bricks, or -1): guided where the brick knows of open
// sky, by the sky's own brightness else. `radiance` is divided by the density.
LightSample sampleSkyGuided(const SkyGuide& guide, int32_t brick, const Lights& lights, Vec2 u, float choice);

// Density with which sampleSkyGuided chooses direction d, per steradian.
float pdfSkyGuided(const SkyGuide& guide, int32_t brick, const Lights& lights, Vec3 d);

// The brick that holds point p, or -1.
inline int32_t brickOf(const Voxels& voxels, Vec3 p) {
  const Int3 v = voxels.voxelOf(p);
  if (v.x < 0 || v.y < 0 || v.z < 0) return -1;
  return voxels.brickAt({v.x / kBrickSize, v.y / kBrickSize, v.z / kBrickSize});
}

}  // namespace roomlight
