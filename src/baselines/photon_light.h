// What technique `photon` knows of a scene's light before it draws: photon maps, irradiance at photons, where the sky
 // is seen.
#pragma once

#include "baselines/photon_estimate.h"
#include "baselines/photon_importance.h"
#include "baselines/sky_survey.h"

namespace roomlight {

struct PhotonLight {
  PhotonMap global, caustic;
  IrradianceCache irradiance;  // with final gathering
  SkySurvey survey;
  uint64_t emitted = 0, rays = 0;
  size_t bytes() const { return global.bytes() + caustic.bytes() + irradiance.bytes() + survey.voxels.bytes(); }
};

// For what `start` asks about. Refers to nothing afterwards. Stopped early it is of no use.
PhotonLight lightPhotons(const RayScene& rays, const Lights& lights, const ImportonStart& start,
                         const PhotonSettings& settings, const Progress& progress = {});

}  // namespace roomlight
