#include "gather/cone_gather.h"

namespace roomlight {

GatheredPicture gatherCones(const TracedScene& scene, const Voxels& voxels, const RadianceField& field,
                            const Camera& camera, const ConeGatherSettings& settings, const Progress& progress) {
  const auto& [rays, lights] = scene;
  return gatherPicture(rays, lights, ConeShader(rays, lights, voxels, field, settings), camera, settings, progress);
}

}  // namespace roomlight
