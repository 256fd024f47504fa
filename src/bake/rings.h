// Wide level surfaces, such as the ground under a chair, cut in rings around what stands on them: texels can be fine
// near by and coarse further out.
#pragma once

#include <cstdint>
#include <vector>

#include "scene/scene.h"

namespace roomlight::bake {

constexpr uint8_t kNoRing = 255;

// The ring of each triangle, 0: the innermost. By mesh; empty: it is not cut.
using Rings = std::vector<std::vector<uint8_t>>;

// How large a scene is to look at, m: its things, where all else is level, as a ground; else the whole.
float extentLookedAt(const Scene& scene);

// Cuts surfaces more than `wideM` wide, if they are at least twice as wide as what stands on them, with its shadow by a
// sun 45° high. Each ring is four times as wide as the one within. No surface moves; triangles keep their numbers, of
// one that is cut the rest follow after all others. Meshes that are placed more than once stay whole.
Rings cutIntoRings(Scene& scene, float wideM);

}  // namespace roomlight::bake
