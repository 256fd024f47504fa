// Directional pyramid from the light on slots.
#pragma once

#include <span>

#include "radiance/radiance_field.h"

namespace roomlight {

// Fills field.levels and field.unitCdM2 from the radiance that each slot sends out (cd/m² per channel).
void buildPyramid(const Voxels& voxels, std::span<const Vec3> slotRadiance, RadianceField& field);

}  // namespace roomlight
