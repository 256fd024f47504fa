#include "mix/mixer.h"

#include <bit>
#include <cassert>

#include "base/parallel.h"

namespace roomlight {
namespace {

constexpr float kBrightest = 4;  // of the mean: a bulb in the picture does not rule over the room

void pack(const Vec3* pixels, size_t count, PackedTile& tile, uint8_t& black) {
  uint32_t any = 0;
  for (int c = 0; c < 3; ++c) {
    for (size_t i = 0; i < count; ++i) {
      assert(pixels[i][c] >= 0 && pixels[i][c] < kInfinity);
      const auto rounded =
          (std::bit_cast<uint32_t>(std::max(0.0f, pixels[i][c])) + 0x40u) >> 7;  // of -0 and 0 the latter
      tile.high[c][i] = static_cast<uint16_t>(rounded >> 8);
      tile.low[c][i] = static_cast<uint8_t>(rounded & 0xffu);
      any |= rounded;
    }
  }
  black = any == 0;
}

// In the order of pixels, so that the number of threads does not matter.
Vec3 clippedMean(const Image& image) {
  const double count = static_cast<double>(image.pixels.size());
  double mean = 0, sum[3] = {};
  for (const Vec3& p : image.pixels) mean += static_cast<double>(luminance(p));
  const auto brightest = static_cast<float>(static_cast<double>(kBrightest) * mean / count);
  for (const Vec3& p : image.pixels) {
    const float l = luminance(p), share = l > brightest ? brightest / l : 1.0f;
    for (int c = 0; c < 3; ++c) sum[c] += static_cast<double>(p[c] * share);
  }
  return {static_cast<float>(sum[0] / count), static_cast<float>(sum[1] / count), static_cast<float>(sum[2] / count)};
}

}  // namespace

LayerStack makeLayerStack(int width, int height, size_t layerCount) {
  LayerStack stack;
  stack.width = width, stack.height = height, stack.layerCount = layerCount;
  stack.tiles.resize(stack.runCount() * layerCount);
  stack.black.assign(stack.tiles.size(), 1);
  stack.meanRgb.resize(layerCount);
  return stack;
}

void setLayer(LayerStack& stack, size_t layer, const Image& image) {
  assert(image.width == stack.width && image.height == stack.height && layer < stack.layerCount);
  parallelFor(stack.runCount(), 16, [&](size_t run) {
    const size_t begin = run * kTilePixels, count = std::min(kTilePixels, stack.pixelCount() - begin),
                 tile = run * stack.layerCount + layer;
    pack(image.pixels.data() + begin, count, stack.tiles[tile], stack.black[tile]);
  });
  stack.meanRgb[layer] = clippedMean(image);
}

}  // namespace roomlight
