// Where surfaces see the sky: what the other techniques learn on the way, for those that have no light in voxels. With
// it they sample the sky through windows as well as the others do.
#pragma once

#include "radiance/carried.h"
#include "radiance/radiance_field.h"
#include "voxel/voxelise.h"

namespace roomlight {

struct SkySurvey {
  Voxels voxels;  // of which the bricks alone count; empty, as the guide is, where there is no sky
  SkyGuide guide;
  uint64_t rays = 0;
};

// Of given voxels. Where bricks are carried only the others are asked, whose guides alone come out (see carriedGuide).
SkyGuide surveySky(const RayScene& rays, const Lights& lights, const Voxels& voxels, const Carried* carried,
                   int raysPerSlot, uint64_t seed, uint64_t& rayCount, const Progress& progress = {});

// `raysPerSlot` rays from every side of every voxel, spread by the cosine. Only chooses directions: it never biases.
SkySurvey surveySky(const RayScene& rays, const Lights& lights, const VoxelSettings& settings, int raysPerSlot,
                    uint64_t seed, const Progress& progress = {});

}  // namespace roomlight
