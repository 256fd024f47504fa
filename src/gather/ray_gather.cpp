#include "gather/ray_gather.h"

#include <algorithm>

#include "gather/hit_survey.h"
#include "gather/ray_shader.h"

namespace roomlight {
namespace {

constexpr float kCellsAVoxel = 2, kSmallestCellM = 0.02f, kLargestCellM = 0.06f;

RayGatherSettings withCells(RayGatherSettings settings, float voxelM) {
  if (settings.hitCellM == 0) settings.hitCellM = std::clamp(voxelM / kCellsAVoxel, kSmallestCellM, kLargestCellM);
  return settings;
}

}  // namespace

RayGather::RayGather(const RayScene& rays, const Lights& lights, const Voxels& voxels, const RadianceField& field, const Camera& camera, const RayGatherSettings& settings, const Progress& progress)
    : rays_(rays), lights_(lights), camera_(camera), settings_(withCells(settings, voxels.voxelSizeM)) {
  shader_ = std::make_unique<RayShader>(rays_, lights_, voxels, field, settings_);
  const bool surveys = settings_.hitCellM > 0 && !shader_->layers();
  settings_.rareApart = surveys && settings_.filterPasses > 0;
  if (!surveys) return;
  GatherCounters count;
  surveyHits(rays_, lights_, *shader_, camera_, settings_, voxels.voxelSizeM, progress, count);
  surveyRays_ = count.rays;
}

RayGather::~RayGather() = default;

GatheredPicture RayGather::picture(RayGatherSettings settings, const Progress& progress) const {
  settings.rareApart = settings_.rareApart;
  GatheredPicture picture = gatherPicture(rays_, lights_, *shader_, camera_, settings, progress);
  picture.rays += surveyRays_;
  return picture;
}

GatheredPicture gatherRays(const RayScene& rays, const Lights& lights, const Voxels& voxels, const RadianceField& field, const Camera& camera,
                           const RayGatherSettings& settings, const Progress& progress) {
  return RayGather(rays, lights, voxels, field, camera, settings, progress).picture(settings, progress);
}

}  // namespace roomlight
