// What the settings of a picture mean for the stages of each technique.
#pragma once

#include "engine/lit_scene.h"
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

// For one picture of a lit scene.
template <class Settings>
Settings asked(const Settings& settings, const PictureWish& wish) {
  Settings out = sized(settings, wish.width, wish.height);
  if (wish.samples > 0) out.samples = wish.samples;
  if (wish.seed) out.seed = *wish.seed;
  out.white = wish.white;
  if constexpr (requires { out.orNothing; }) out.orNothing = wish.orNothing;
  return out;
}

}  // namespace roomlight
