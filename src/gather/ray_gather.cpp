#include "gather/ray_gather.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "gather/hit_survey.h"
#include "gather/ray_shader.h"

namespace roomlight {
namespace {

constexpr double kPixelsOfCounts = 480 * 270;  // that counts of rays in the settings are meant for, at most
constexpr int kLaterPass =
    4;  // rays of a pixel; after the first pass, in whole multiples, as sequences are made for powers of two
constexpr unsigned kMostLaterShare = 2;
constexpr float kCellsAVoxel = 2, kSmallestCellM = 0.02f, kLargestCellM = 0.06f;

}  // namespace

RayGatherSettings withCounts(RayGatherSettings settings) {
  if (!settings.countsBySize) return settings;
  settings.countsBySize = false;
  const double times = std::max(1.0, static_cast<double>(settings.width) * settings.height / kPixelsOfCounts);
  const auto wider = std::bit_floor(static_cast<unsigned>(std::sqrt(times)));
  if (settings.estimates > 1) {  // of a single estimate in a single shading no noise is known
    settings.laterShare = static_cast<int>(std::min(kMostLaterShare, wider));
    settings.raysPerShading *= static_cast<int>(std::max(1u, wider / 2));
  }
  const int later = settings.samples - settings.firstSamples,
            passes = std::max(1, static_cast<int>(std::lround(later / (times * kLaterPass))));
  if (later > kLaterPass) settings.samples = settings.firstSamples + std::min(later, kLaterPass * passes);
  return settings;
}

RayGatherSettings withCells(RayGatherSettings settings, float voxelM) {
  if (settings.hitCellM == 0) settings.hitCellM = std::clamp(voxelM / kCellsAVoxel, kSmallestCellM, kLargestCellM);
  return settings;
}

void SurveyedShader::shade(std::span<const Shading> work, std::span<const Shadow> shadows,
                           std::span<SurfaceLight> light, GatherCounters& count) const {
  shader_.shade(work, shadows, light, nullptr, &survey_, count);
}

void SurveyedShader::shadeInLayers(std::span<const Shading> work, std::span<const Shadow> shadows,
                                   std::span<SurfaceLight> light, LayerSums& layers, GatherCounters& count) const {
  shader_.shade(work, shadows, light, &layers, &survey_, count);
}

const LightLayers* SurveyedShader::layers() const { return shader_.layers(); }

RayGather::RayGather(const RayScene& rays, const Lights& lights, const RayShader& shader, const Camera& camera,
                     const RayGatherSettings& settings, const Progress& progress)
    : rays_(rays), lights_(lights), shader_(shader), camera_(camera) {
  if (settings.hitCellM > 0)
    survey_ = std::make_unique<HitSurvey>(surveyHits(rays_, lights_, shader_, camera_, settings, progress));
}

RayGather::~RayGather() = default;

GatheredPicture RayGather::picture(RayGatherSettings settings, const Progress& progress) const {
  settings = withCounts(settings);
  settings.rareApart = survey_ && settings.filterPasses > 0;
  if (!survey_) return gatherPicture(rays_, lights_, shader_, camera_, settings, progress);
  GatheredPicture picture =
      gatherPicture(rays_, lights_, SurveyedShader(shader_, *survey_), camera_, settings, progress);
  picture.rays += survey_->rays;
  return picture;
}

GatheredPicture gatherRays(const TracedScene& scene, const Voxels& voxels, const RadianceField& field,
                           const Camera& camera, const RayGatherSettings& settings, const Progress& progress) {
  const auto& [rays, lights] = scene;
  const RayGatherSettings use = withCells(settings, voxels.voxelSizeM);
  const RayShader shader(rays, lights, voxels, field, use);
  return RayGather(rays, lights, shader, camera, use, progress).picture(use, progress);
}

}  // namespace roomlight
