// Texels of light without loss, as what differs from a prediction (docs/reference/baked.md, light): a fifth
// less, deflated, than the texels themselves.
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace roomlight::bake {

// Of tiles of `width` x `height` texels (RGB9_E5), rows from the top left, one tile after the other: four planes of as
// many bytes as there are texels, those of green, red and blue, and one of the exponent and their highest bits.
std::string predictedPlanes(std::span<const uint32_t> texels, int width, int height);

}  // namespace roomlight::bake
