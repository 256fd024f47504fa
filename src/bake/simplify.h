// Fewer triangles for what is finer than a picture shows.
#pragma once

#include <vector>

#include "scene/scene.h"

namespace roomlight::bake {

// Meshes in which no place of the surface is farther than `errorM` from where it was, as far as edges of quadrics tell;
// borders, seams of normals and texture coordinates stay. Thin meshes are moved less: planks, tiles and rugs lie
// millimetres above other things, which would come through. A mesh that is placed larger than it is made is simplified
// less. Returns of each mesh how far places may have moved, m in the world; 0: it has all its triangles.
std::vector<float> simplifyMeshes(Scene& scene, float errorM);

}  // namespace roomlight::bake
