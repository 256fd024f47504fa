#include "bake/light_texels.h"

#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <utility>

#include "bake/predicted_texels.h"

namespace roomlight::bake {
namespace {

constexpr int kMantissaBits = 9, kBias = 15, kMostExponent = 31;
constexpr float kLargest = 65408;  // (2^9 - 1) / 2^9 * 2^16
constexpr float kDarkLux = 0.01f;  // a tile that is nowhere brighter is left out

float clipped(float v) { return v > 0 ? std::min(v, kLargest) : 0; }

float scaleOf(const Image& light) {
  float most = 0;
  for (const Vec3 v : light.pixels) most = std::max(most, maxComponent(v));
  // A power of two, which loses nothing.
  return most > kLargest ? std::exp2(std::ceil(std::log2(most / kLargest))) : 1;
}

void addTile(const Image& light, int tile, uint32_t number, float scale, std::vector<uint32_t>& texels) {
  const int across = light.width / tile;
  const int left = static_cast<int>(number) % across * tile, top = static_cast<int>(number) / across * tile;
  for (int y = 0; y < tile; ++y) {
    for (int x = 0; x < tile; ++x) texels.push_back(rgb9e5(light.at(left + x, top + y) / scale));
  }
}

// The tiles in which `wanted` holds of some texel.
LightTexels tilesWhere(const Image& light, int tile, int slack, const std::function<bool(int, int)>& wanted) {
  LightTexels out;
  out.scale = scaleOf(light);
  std::vector<uint32_t> texels;
  const int across = light.width / tile, count = across * (light.height / tile);
  for (int t = 0; t < count; ++t) {
    bool any = false;
    for (int i = 0; !any && i < tile * tile; ++i)
      any = wanted(t % across * tile + i % tile, t / across * tile + i / tile);
    if (!any) continue;
    out.tiles.push_back(static_cast<uint32_t>(t));
    addTile(light, tile, static_cast<uint32_t>(t), out.scale, texels);
  }
  out.stream = deflated(predictedPlanes(std::move(texels), tile, tile, slack));
  return out;
}

}  // namespace

uint32_t rgb9e5(Vec3 value) {
  const Vec3 v{clipped(value.x), clipped(value.y), clipped(value.z)};
  const float most = maxComponent(v);
  if (most <= 0) return 0;
  int exponent = std::clamp(std::ilogb(most) + 1 + kBias, 0, kMostExponent);
  const auto mantissa = [&](float c) {
    return static_cast<uint32_t>(std::lround(std::ldexp(c, kMantissaBits + kBias - exponent)));
  };
  if (mantissa(most) > 511) ++exponent;
  return mantissa(v.x) | mantissa(v.y) << 9 | mantissa(v.z) << 18 | static_cast<uint32_t>(exponent) << 27;
}

Vec3 fromRgb9e5(uint32_t texel) {
  const float scale = std::ldexp(1.0f, static_cast<int>(texel >> 27) - kBias - kMantissaBits);
  return Vec3(static_cast<float>(texel & 511), static_cast<float>(texel >> 9 & 511),
              static_cast<float>(texel >> 18 & 511)) *
         scale;
}

LightTexels lightTexels(const Image& light, int tile, int slack) {
  return tilesWhere(light, tile, slack, [&](int x, int y) { return maxComponent(light.at(x, y)) > kDarkLux; });
}

LightTexels changedTexels(const Image& before, const Image& after, int tile, int slack) {
  return tilesWhere(after, tile, slack, [&](int x, int y) { return !(before.at(x, y) == after.at(x, y)); });
}

LightTexels lightTexels(const Image& picture) {
  LightTexels out;
  out.scale = scaleOf(picture);
  std::vector<uint32_t> texels;
  for (const Vec3 v : picture.pixels) texels.push_back(rgb9e5(v / out.scale));
  out.tiles = {0};
  out.stream = deflated(predictedPlanes(std::move(texels), picture.width, picture.height, kSlack));
  return out;
}

MaskTexels maskTexels(const SunMask& mask, int width, int tile) {
  MaskTexels out;
  out.channels = mask.coloured ? 3 : 1;
  if (!mask.any()) return out;
  const auto row = static_cast<size_t>(width) * kFineCells, edge = static_cast<size_t>(tile) * kFineCells;
  const size_t across = row / edge, count = mask.left.size() / (edge * edge);
  std::string bytes;
  for (size_t t = 0; t < count; ++t) {
    const auto at = [&](size_t x, size_t y) -> const std::array<uint8_t, 3>& {
      return mask.left[(t / across * edge + y) * row + t % across * edge + x];
    };
    bool dark = true;
    for (size_t i = 0; dark && i < edge * edge; ++i) dark = at(i % edge, i / edge) == std::array<uint8_t, 3>{};
    if (dark) continue;
    out.tiles.push_back(static_cast<uint32_t>(t));
    // Green stands for all where they are alike.
    for (size_t c = mask.coloured ? 0 : 1; c < (mask.coloured ? 3u : 2u); ++c) {
      for (size_t i = 0; i < edge * edge; ++i) {
        const size_t x = i % edge, y = i / edge;
        bytes.push_back(static_cast<char>(at(x, y)[c] - (x > 0 ? at(x - 1, y)[c] : 0)));
      }
    }
  }
  out.stream = deflated(bytes);
  return out;
}

std::string deflated(std::string_view bytes) {
  uLongf size = compressBound(static_cast<uLong>(bytes.size()));
  std::string out(size, '\0');
  if (compress2(reinterpret_cast<Bytef*>(out.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
                static_cast<uLong>(bytes.size()), Z_BEST_COMPRESSION) != Z_OK)
    throw std::runtime_error("light cannot be compressed");
  out.resize(size);
  return out;
}

}  // namespace roomlight::bake
