// Fills the cache of hits for one camera: rays of few pixels tell where gathering rays of its picture arrive, and samples of the light there are taken.
#pragma once

#include "gather/ray_shader.h"

namespace roomlight {

// Hands both to the shader: the cache, and the guide towards what is bright in it. Counts its rays in `count`. Does neither once progress says stop.
void surveyHits(const RayScene& rays, const Lights& lights, RayShader& shader, const Camera& camera, const RayGatherSettings& settings, float voxelM, const Progress& progress, GatherCounters& count);

}  // namespace roomlight
