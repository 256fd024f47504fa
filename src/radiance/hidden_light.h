// Light that reaches slots from surfaces that no slot stands for: the inside of shelves, fronts beside one another in a
// voxel.
#pragma once

#include <vector>

#include "radiance/links.h"
#include "trace/light_layers.h"

namespace roomlight {

// Lights that fall straight on hidden places along links go on to these links' slots: lx per slot, of all lights
// together or, where layers are given, of each layer apart. What particles bring near lamps is left out.
std::vector<std::vector<Vec3>> lightOfHidden(const RayScene& rays, const Lights& lights, const Voxels& voxels,
                                             const SlotPaths& paths, const Links& links, const SkyGuide& guide,
                                             const SeenLights& seen, const LightLayers* layers, uint64_t seed,
                                             uint64_t& rayCount);

}  // namespace roomlight
