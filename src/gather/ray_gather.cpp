#include "gather/ray_gather.h"

#include <algorithm>

#include "gather/hit_survey.h"
#include "gather/ray_shader.h"

namespace roomlight {
namespace {

constexpr float kCellsAVoxel = 2, kSmallestCellM = 0.02f, kLargestCellM = 0.06f;

}  // namespace

GatheredPicture gatherRays(const RayScene& rays, const Lights& lights, const Voxels& voxels, const RadianceField& field, const Camera& camera,
                           const RayGatherSettings& settings, const Progress& progress) {
  RayGatherSettings use = settings;
  if (use.hitCellM == 0) use.hitCellM = std::clamp(voxels.voxelSizeM / kCellsAVoxel, kSmallestCellM, kLargestCellM);
  RayShader shader(rays, lights, voxels, field, use);
  const bool surveys = use.hitCellM > 0 && !shader.layers();
  use.rareApart = surveys && use.filterPasses > 0;
  GatherCounters count;
  if (surveys) surveyHits(rays, lights, shader, camera, use, voxels.voxelSizeM, progress, count);
  GatheredPicture picture = gatherPicture(rays, lights, shader, camera, use, progress);
  picture.rays += count.rays;
  return picture;
}

}  // namespace roomlight
