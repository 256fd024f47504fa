// Texels of light as what differs from a prediction (docs/reference/baked.md, light): without loss a fifth less,
// deflated, than the texels themselves.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace roomlight::bake {

// Of tiles of `width` x `height` texels (RGB9_E5), rows from the top left, one tile after the other: four planes of as
// many bytes as there are texels, those of green, red and blue, and one of the exponent and their highest bits. A
// mantissa may come back `slack` away from what it is, where that is nearer to the prediction (near-lossless JPEG-LS:
// Weinberger, Seroussi & Sapiro 2000); 0: without loss.
std::string predictedPlanes(std::vector<uint32_t> texels, int width, int height, int slack);

}  // namespace roomlight::bake
