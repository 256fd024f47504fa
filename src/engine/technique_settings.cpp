#include "engine/technique_settings.h"

namespace roomlight {
namespace {

// Rays decide what is seen, so voxels may be coarser than cones need them: a third of the slots, and no more error.
constexpr float kCoarser = 1.5f;
constexpr int kDefaultSamples = 256;  // of path
constexpr int kMostForNoise = 256;    // of hybrid, until no pixel has more noise than asked
constexpr int kNoLimit = 1 << 24;

// Size, samples and seed of all techniques in the settings of one.
void applyPictureSettings(const RenderSettings& from, PictureSettings& to) {
  to.width = from.width;
  to.height = from.height;
  to.seed = from.seed;
  if (from.samples > 0) to.samples = from.samples;
}

}  // namespace

StageSettings<RayGatherSettings> hybridStages(const RenderSettings& settings) {
  StageSettings<RayGatherSettings> out{settings.voxel, settings.radiance, settings.hybrid};
  out.voxel.sizeFactor *= kCoarser;
  out.radiance.seed = settings.seed;
  out.radiance.pyramid = false;
  out.radiance.still = true;
  applyPictureSettings(settings, out.gather);
  if (settings.noiseLevel > 0) {
    out.gather.tolerance = static_cast<float>(settings.noiseLevel);
    if (settings.samples == 0) out.gather.samples = kMostForNoise;
  }
  return out;
}

StageSettings<GatherSettings> coneStages(const RenderSettings& settings) {
  StageSettings<GatherSettings> out{settings.voxel, settings.radiance, settings.gather};
  out.radiance.seed = settings.seed;
  applyPictureSettings(settings, out.gather);
  return out;
}

VxgiSettings vxgiStage(const RenderSettings& settings) {
  VxgiSettings out = settings.vxgi;
  applyPictureSettings(settings, out);
  return out;
}

LpvSettings lpvStage(const RenderSettings& settings) {
  LpvSettings out = settings.lpv;
  applyPictureSettings(settings, out);
  return out;
}

PhotonSettings photonStage(const RenderSettings& settings) {
  PhotonSettings out = settings.photon;
  applyPictureSettings(settings, out);
  return out;
}

PathSettings pathStage(const RenderSettings& settings) {
  PathSettings path = settings.path;
  path.width = settings.width;
  path.height = settings.height;
  const bool endsOtherwise = settings.timeLimitS > 0 || settings.noiseLevel > 0;
  path.samples = settings.samples > 0 ? settings.samples : endsOtherwise ? kNoLimit : kDefaultSamples;
  path.timeLimitS = settings.timeLimitS;
  path.noiseLevel = settings.noiseLevel;
  path.seed = settings.seed;
  return path;
}

}  // namespace roomlight
