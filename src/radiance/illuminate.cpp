#include "radiance/light_cache.h"

namespace roomlight {

size_t RadianceField::bytes() const {
  size_t sum = irradianceLux.size() * sizeof(Vec3) + guide.cdf.size() * sizeof(guide.cdf[0]) + seen.bytes() +
               glow.bytes() + layers.bytes() + glowShare.size() * sizeof(float);
  for (const RadianceLevel& level : levels) {
    sum += level.brickIndex.size() * sizeof(int32_t) + level.bricks.size() * sizeof(Brick) +
           level.planes.size() * (sizeof(DirectionalPlanes) + sizeof(DirectionalLight));
  }
  return sum;
}

RadianceField illuminate(const RayScene& rays, const Lights& lights, const Voxels& voxels,
                         const RadianceSettings& settings, const Progress& progress) {
  return LightCache(rays, lights, voxels, settings, progress).take();
}

}  // namespace roomlight
