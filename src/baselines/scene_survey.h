// What rival techniques find out about a scene by rays: the room of the eye, the sides that surfaces show, where the
// sky is seen.
#pragma once

#include <cstdint>
#include <vector>

#include "radiance/radiance_field.h"
#include "radiance/slot_remap.h"
#include "trace/ray_scene.h"
#include "trace/traced_scene.h"
#include "voxel/voxelise.h"
#include "voxel/voxels.h"

namespace roomlight {

// Where techniques that are finest about one place begin: what surrounds `eye`, as far as the
// first surfaces in all directions, and the eye itself, which may be outside of all it sees; a few of the farthest
// surfaces are left out.
Bounds3 roomAround(const RayScene& rays, Vec3 eye);

// Which sides of voxels' surfaces are ones that their materials show.
bool isDoubleSided(const Scene& scene, const FaceSlot& slot);
// Whether a slot shows the front of its triangles.
bool isFront(const RayScene& rays, const FaceSlot& slot, float voxelSizeM);
// Per slot: both sides of double-sided materials, else the front.
std::vector<uint8_t> shownSides(const RayScene& rays, const Voxels& voxels);

// Where surfaces see the sky: what the other techniques learn on the way, for those that have no light in voxels. With
// it they sample the sky through windows as well as the others do.
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
