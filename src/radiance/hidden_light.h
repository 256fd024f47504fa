// Light that reaches slots from surfaces that no slot stands for: the inside of shelves, fronts beside one another in a voxel.
#pragma once

#include <vector>

#include "radiance/links.h"
#include "trace/light_layers.h"

namespace roomlight {

struct OneLayer {
  const LightLayers& layers;
  int32_t layer;
};

// Lights that fall straight on hidden places along links go on to these links' slots: lx per slot, of all lights together, or, where given, of one layer's. What particles bring near lamps is left out.
std::vector<Vec3> lightOfHidden(const RayScene& rays, const Lights& lights, const Voxels& voxels, const SlotPaths& paths, const Links& links, const SkyGuide& guide, const SeenLights& seen, uint64_t seed, uint64_t& rayCount,
                                const OneLayer* only = nullptr);

}  // namespace roomlight
