#include "gather/ray_gather.h"

#include "gather/ray_shader.h"

namespace roomlight {

GatheredPicture gatherRays(const RayScene& rays, const Lights& lights, const Voxels& voxels, const RadianceField& field, const Camera& camera,
                           const RayGatherSettings& settings, const Progress& progress) {
  return gatherPicture(rays, lights, RayShader(rays, lights, voxels, field, settings), camera, settings, progress);
}

}  // namespace roomlight
