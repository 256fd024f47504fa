// The first bounce off surfaces that no slot stands for.
#pragma once

#include <vector>

#include "radiance/links.h"
#include "radiance/radiance_field.h"
#include "radiance/slot_paths.h"
#include "trace/light_layers.h"
#include "trace/traced_scene.h"

namespace roomlight {

// Light that reaches slots from surfaces that no slot stands for: the inside of shelves, fronts beside one another in a
// voxel. Lights that fall straight on hidden places along links go on to these links' slots: lx per slot, of all lights
// together or, where layers are given, of each layer apart. What particles bring near lamps is left out. `field`: with
// what is known of where lights and the sky are seen.
std::vector<std::vector<Vec3>> lightOfHidden(const TracedScene& scene, const SlotSampling& slots, const Links& links,
                                             const RadianceField& field, const LightLayers* layers, uint64_t& rayCount);

}  // namespace roomlight
