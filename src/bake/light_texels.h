// The light of one layer as a stream of texels (docs/reference/baked.md): RGB9_E5 in tiles, predicted, deflated.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "bake/sun_mask.h"
#include "base/image.h"
#include "base/vec.h"

namespace roomlight::bake {

// Three mantissas of 9 bits from the lowest bit on and a common exponent of 5 bits (OpenGL's RGB9_E5), within 0.2 % of
// the largest channel. Values from 0 to 65 408; what is above is clipped, what is below 0 or not a number is 0.
uint32_t rgb9e5(Vec3 value);
Vec3 fromRgb9e5(uint32_t texel);

struct LightTexels {
  float scale = 1;              // values times this are lux or cd/m²
  std::vector<uint32_t> tiles;  // that are not dark, in rising order
  std::string stream;           // a zlib stream
};

constexpr int kSlack = 1;  // of a mantissa: .4 % of the largest channel

// Of a picture of light whose edges are multiples of `tile`. Mantissas are off by at most `slack`.
LightTexels lightTexels(const Image& light, int tile, int slack = kSlack);
// Of a layer whose places were lit anew: the tiles that differ from before, whole, dark ones among them. They replace
// those of the layer (docs/reference/baked.md, changes).
LightTexels changedTexels(const Image& before, const Image& after, int tile, int slack = kSlack);
// Of a picture as one tile of any size.
LightTexels lightTexels(const Image& picture);

struct MaskTexels {
  int channels = 1;             // 3: linear red, green and blue, plane by plane in each tile
  std::vector<uint32_t> tiles;  // that are not dark, in rising order
  std::string stream;           // a zlib stream
};

// Cells of an atlas `width` texels wide, in tiles of `tile` texels. Each byte is the difference to the one left of it.
MaskTexels maskTexels(const SunMask& mask, int width, int tile);

// Raw bytes as a zlib stream (RFC 1950).
std::string deflated(std::string_view bytes);

}  // namespace roomlight::bake
