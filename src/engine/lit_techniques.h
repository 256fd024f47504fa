// What lit_scene.cpp chooses among: lit scenes of the techniques that keep light in voxels or grids, each in a file of
 // its own.
#pragma once

#include "engine/lit_scene.h"

namespace roomlight {

std::unique_ptr<LitScene> lightByVoxels(const Scene& scene, const RenderSettings& settings, Stages& stages,
                                        bool changes);  // hybrid and cone
std::unique_ptr<LitScene> lightByVxgi(const Scene& scene, const RenderSettings& settings, Stages& stages,
                                      const Camera* camera);
std::unique_ptr<LitScene> lightByLpv(const Scene& scene, const RenderSettings& settings, Stages& stages,
                                     const Camera* camera);

}  // namespace roomlight
