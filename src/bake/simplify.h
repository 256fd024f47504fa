// Fewer triangles for what is finer than a picture shows.
#pragma once

#include <span>
#include <vector>

#include "scene/scene.h"

namespace roomlight::bake {

// How much coarser each instance may be for being far from all eyes: its distance in metres, from 1 to 20.
std::vector<float> coarserFar(const Scene& scene, std::span<const Vec3> eyes);

// Meshes in which no place of the surface is farther than `errorM` from where it was, as far as edges of quadrics
// tell; borders, seams of normals and texture coordinates stay. Thin meshes are moved less: planks, tiles and rugs lie
// millimetres above other things, which would come through. A mesh that is placed larger than it is made is simplified
// less. `coarser`: times so much, by instance; none: 1. Returns of each mesh how far places may
// have moved, m in the world; 0: it has all its triangles.
std::vector<float> simplifyMeshes(Scene& scene, float errorM, std::span<const float> coarser = {});

}  // namespace roomlight::bake
