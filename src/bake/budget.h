// Settings with which a baked home is no larger than asked.
#pragma once

#include <cstddef>

#include "bake/bake.h"

namespace roomlight::bake {

// Bytes of a file by what they are for.
struct FileParts {
  double geometry = 0, textures = 0, light = 0;
  double sum() const { return geometry + textures + light; }
};

constexpr int kSmallestTexture = 128;  // pixels, an edge

// Coarser step by step, what gains most first: surfaces that may be twice as far off (at most 16 mm), textures of half
// the edge (at least the smallest), texels of light of half the area (at most four times as long). `parts`: with
// `settings` as they are. As coarse as it goes where that is not enough.
BakeSettings withinBudget(BakeSettings settings, FileParts parts, size_t bytes);

}  // namespace roomlight::bake
