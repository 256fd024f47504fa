// The light of every layer, packed for mixing: floats of 24 bits, in the order in which mixing reads them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/image.h"

namespace roomlight {

// A float without its sign and its lowest 7 bits, rounded to nearest: relative error at most 2^-17. After exposure,
// tone curve and sRGB that is below 1/512 of a display step (docs/measured/mix.md); half floats are off by up to 1/30
// of one.
inline constexpr size_t kTilePixels = 1024;
struct alignas(32) PackedTile {
  uint16_t high[3][kTilePixels];  // red, green, blue
  uint8_t low[3][kTilePixels];
};

struct LayerStack {
  int width = 0, height = 0;
  size_t layerCount = 0;
  std::vector<PackedTile> tiles;  // of a run of pixels all layers lie together: tiles[run * layerCount + layer]
  std::vector<uint8_t> black;     // like tiles: 1 where there is no light at all
  std::vector<Vec3> meanRgb;  // a layer's mean; of pixels brighter than four times the mean only that much counts
  size_t pixelCount() const { return static_cast<size_t>(width) * static_cast<size_t>(height); }
  size_t runCount() const { return (pixelCount() + kTilePixels - 1) / kTilePixels; }
};

// Room for that many layers, all black. 9 bytes a pixel and layer.
LayerStack makeLayerStack(int width, int height, size_t layerCount);

// Packs a picture of the stack's size as one of its layers: finite light, not negative.
void setLayer(LayerStack& stack, size_t layer, const Image& image);

}  // namespace roomlight
