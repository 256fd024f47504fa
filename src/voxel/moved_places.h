// Where things that moved were and are.
#pragma once

#include <span>
#include <vector>

#include "scene/scene_change.h"
#include "voxel/voxelise.h"

namespace roomlight {

// Brings the voxels up to date and returns the boxes outside which the change left the scene as it was: one an object,
// or two where it went far.
std::vector<Bounds3> followMoves(Voxelisation& voxels, const Scene& scene, const SceneChange& change);

}  // namespace roomlight
