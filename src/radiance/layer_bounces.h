// Bounces of several lights at once: links are read once for all of them.
#pragma once

#include <span>

#include "radiance/bounces.h"

namespace roomlight {

constexpr size_t kLayersAtOnce = 8;  // lights

// As bounce() in bounces.h for each of at most kLayersAtOnce lights from darkness on, with as many steps as `like` took
// for their sum. direct[k] and indirect[k]: lx per slot. Half floats in between: within about a thousandth.
void bounceLayers(const Voxels& voxels, const Links& links, std::span<const std::vector<Vec3>> direct,
                  std::span<std::vector<Vec3>> indirect, const Bounces& like, const Progress& progress);

}  // namespace roomlight
