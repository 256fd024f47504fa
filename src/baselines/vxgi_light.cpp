#include "baselines/vxgi_cache.h"

namespace roomlight {

VxgiLight lightVxgi(const RayScene& rays, const Lights& lights, const Bounds3& room, const VxgiSettings& settings,
                    const Progress& progress) {
  return VxgiCache(rays, lights, room, settings, progress).take();
}

}  // namespace roomlight
