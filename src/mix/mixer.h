// Sums of layers: light adds up, so any state of the lamps is one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/image.h"
#include "base/tone.h"

namespace roomlight {

// The light of every layer is packed for mixing: floats of 24 bits, in the order in which mixing reads them.
//
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

// Lamps that are switched on and off, over what shines in every state.
struct Switches {
  std::vector<Vec3> gains;    // of every layer, as it shines when it shines
  std::vector<size_t> lamps;  // layers that are switched; bit i of a mask says whether lamps[i] is on
};

constexpr size_t kMostSwitchedLamps = 16;  // 65536 states

// Gains of a state: those of switched lamps that are off are 0.
std::vector<Vec3> gainsOfState(const Switches& switches, uint64_t mask);

// The masks of all states in the order of the reflected Gray code, beginning with all off: each differs from the one
// before in one lamp.
std::vector<uint32_t> allStates(size_t lampCount);

// '1' or '0' a lamp, the first lamp first: a name that does not change when pictures are made anew.
std::string stateName(uint32_t mask, size_t lampCount);

// How a mixed picture is shown (docs/reference/conventions.md, exposure and display).
struct Look {
  float ev100 = 0;
  Tone tone;
  Affine whiteBalance;  // linear Rec.709 to linear Rec.709; no translation
};

// The sum of layers times their gains, one gain a layer: linear, in the layers' unit.
Image mixLinear(const LayerStack& stack, std::span<const Vec3> gains);

// The same, white-balanced, exposed, tone-mapped, dithered and encoded in one pass over memory, which is what limits
// it: 9 bytes a pixel and layer.
ByteImage mixDisplay(const LayerStack& stack, std::span<const Vec3> gains, const Look& look);

}  // namespace roomlight
