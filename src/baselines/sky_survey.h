// Where surfaces see the sky: what the other techniques learn on the way, for those that have no light in voxels. With
// it they sample the sky through windows as well as the others do.
#pragma once

#include "radiance/slot_remap.h"
#include "radiance/radiance_field.h"
#include "trace/traced_scene.h"
#include "voxel/voxelise.h"

namespace roomlight {

struct SkySurvey {
  Voxels voxels;  // of which the bricks alone count; empty, as the guide is, where there is no sky
  SkyGuide guide;
  uint64_t rays = 0;
};

// From every side of every voxel, spread by the cosine.
struct SurveyRays {
  int perSlot;
  uint64_t seed;
};

// Of given voxels. Where bricks are carried only the others are asked, whose guides alone come out (see keptGuide).
SkyGuide surveySky(const TracedScene& scene, const Voxels& voxels, const SlotRemap* remap, const SurveyRays& use,
                   uint64_t& rayCount, const Progress& progress = {});

// Only chooses directions: it never biases.
SkySurvey surveySky(const TracedScene& scene, const VoxelSettings& settings, const SurveyRays& use,
                    const Progress& progress = {});

}  // namespace roomlight
