// What the settings of a picture mean for the stages of each technique.
#pragma once

#include "engine/settings.h"

namespace roomlight {

template <class Gather>
struct StageSettings {
  VoxelSettings voxel;
  RadianceSettings radiance;
  Gather gather;
};

StageSettings<RayGatherSettings> hybridStages(const RenderSettings& settings);
StageSettings<GatherSettings> coneStages(const RenderSettings& settings);
VxgiSettings vxgiStage(const RenderSettings& settings);
LpvSettings lpvStage(const RenderSettings& settings);
PhotonSettings photonStage(const RenderSettings& settings);
PathSettings pathStage(const RenderSettings& settings);

// For a picture of another size.
template <class Settings>
Settings sized(Settings settings, int width, int height) {
  settings.width = width, settings.height = height;
  return settings;
}

}  // namespace roomlight
