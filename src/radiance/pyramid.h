// Directional pyramid from the light on slots.
#pragma once

#include <span>

#include "radiance/radiance_field.h"

namespace roomlight {

// Fills field.levels and field.unitCdM2 from the radiance that each slot sends out (cd/m² per channel). `slotGlow`,
// empty or per slot, comes on top of it and is kept by LampGlow too: only the base level shows it.
void buildPyramid(const Voxels& voxels, std::span<const Vec3> slotRadiance, std::span<const Vec3> slotGlow,
                  RadianceField& field);

}  // namespace roomlight
