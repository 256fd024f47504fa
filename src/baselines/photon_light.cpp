#include "baselines/photon.h"

#include "baselines/photon_trace.h"

namespace roomlight {
namespace {

constexpr float kSurveyVoxelFactor = 2;  // coarser than voxels that light is kept in
constexpr int kSurveyRays = 4;           // from each of their slots

// The part of progress from `begin` to `end`.
Progress partOf(const Progress& progress, float begin, float end) {
  Progress part;
  part.cancelled = progress.cancelled;
  part.report = [&progress, begin, end](float fraction) { progress.at(begin + (end - begin) * fraction); };
  return part;
}

}  // namespace

PhotonLight lightPhotons(const RayScene& rays, const Lights& lights, const ImportonStart& start,
                         const PhotonSettings& settings, const Progress& progress) {
  PhotonLight out;
  const PhotonImportance importance(rays, lights, start, settings.importons, settings.seed);
  out.rays = importance.rays();
  VoxelSettings coarse;
  coarse.sizeFactor = kSurveyVoxelFactor;
  out.survey = surveySky({rays, lights}, coarse, {kSurveyRays, settings.seed}, progress);
  out.rays += out.survey.rays;
  const PhotonTracer tracer(rays, lights, importance, out.survey, settings);
  const auto keep = [&](const TracedPhotons& traced) {
    out.emitted += traced.emitted, out.rays += traced.rays;
    return PhotonMap(traced.photons);
  };
  out.global = keep(tracer.global(settings.finalGather == 0, partOf(progress, 0, 0.3f)));
  out.caustic = keep(tracer.caustics(partOf(progress, 0.3f, 0.5f)));
  if (settings.finalGather > 0) {
    out.irradiance = IrradianceCache(out.global, PhotonEstimate(rays, out.global, settings.nearest, settings), settings,
                                     out.rays, partOf(progress, 0.5f, 1));
  }
  return out;
}

}  // namespace roomlight
