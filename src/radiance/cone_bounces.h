// Bounces as the published study has them: slots gather from the directional pyramid by cones, which is built anew for
 // each bounce.
#pragma once

#include "radiance/bounces.h"
#include "radiance/slot_paths.h"

namespace roomlight {

// As bounce() in bounces.h, by cones in place of links, which is far slower.
Bounces bounceByCones(const Voxels& voxels, const SlotPaths& paths, std::span<const Vec3> direct,
                      std::vector<Vec3>& indirect, const RadianceSettings& settings, const Progress& progress);

}  // namespace roomlight
