// Sheets that lie just above another surface, which would come through if they were simplified.
#pragma once

#include <vector>

#include "trace/ray_scene.h"

namespace roomlight::bake {

// Of each mesh, about the smallest gap, m in the world, between it and a surface behind that faces the same way: a
// cloth on a mattress, a fold of a blanket. Of both; infinite where there is none, or more than `mostM`.
std::vector<float> gapsOf(const RayScene& rays, float mostM);

}  // namespace roomlight::bake
