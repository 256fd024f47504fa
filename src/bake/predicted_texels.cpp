#include "bake/predicted_texels.h"

#include <algorithm>

namespace roomlight::bake {
namespace {

constexpr int kMost = 511;  // of a mantissa of 9 bits

struct Texel {
  int r = 0, g = 0, b = 0, exponent = 0;
};

Texel texelOf(uint32_t t) {
  return {static_cast<int>(t & 511), static_cast<int>(t >> 9 & 511), static_cast<int>(t >> 18 & 511),
          static_cast<int>(t >> 27)};
}

// A mantissa as it would be with another exponent.
int aligned(int mantissa, int exponent, int wanted) {
  const int up = exponent - wanted;
  return up >= 0 ? std::min(mantissa << std::min(up, 9), kMost) : mantissa >> std::min(-up, 9);
}

// Of green, from those on the left, above and between them: where an edge is, the one it does not lie beside (MED:
// Weinberger, Seroussi & Sapiro 2000).
int median(int left, int above, int corner) {
  return std::clamp(left + above - corner, std::min(left, above), std::max(left, above));
}

// Of red or blue from green, by their ratio in a texel beside this one.
int byRatio(int green, int channelBeside, int greenBeside) {
  return greenBeside > 0 ? std::min((green * channelBeside + (greenBeside >> 1)) / greenBeside, kMost) : green;
}

// A mantissa as far from its prediction as some step of 2 slack + 1, and at most `slack` from what it is.
int nearby(int mantissa, int predicted, int slack) {
  const int step = 2 * slack + 1, off = mantissa - predicted;
  const int near = predicted + (off + (off < 0 ? -slack : slack)) / step * step;
  return near >= 0 && near <= kMost ? near : mantissa;
}

uint32_t packed(const Texel& t) {
  return static_cast<uint32_t>(t.r) | static_cast<uint32_t>(t.g) << 9 | static_cast<uint32_t>(t.b) << 18 |
         static_cast<uint32_t>(t.exponent) << 27;
}

// Differences modulo 2^bits, small ones of either sign first.
uint32_t folded(int difference, int bits) {
  const int half = 1 << (bits - 1);
  const int d = ((difference + half) & ((1 << bits) - 1)) - half;
  return static_cast<uint32_t>(d < 0 ? -2 * d - 1 : 2 * d);
}

}  // namespace

std::string predictedPlanes(std::vector<uint32_t> texels, int width, int height, int slack) {
  const size_t count = texels.size(), tile = static_cast<size_t>(width) * static_cast<size_t>(height);
  std::string planes(4 * count, '\0');
  for (size_t i = 0; i < count; ++i) {
    const size_t inTile = i % tile;
    const bool hasLeft = inTile % static_cast<size_t>(width) > 0, hasAbove = inTile >= static_cast<size_t>(width);
    Texel t = texelOf(texels[i]);
    const Texel left = hasLeft ? texelOf(texels[i - 1]) : Texel(),
                above = hasAbove ? texelOf(texels[i - static_cast<size_t>(width)]) : Texel();
    const Texel beside = hasLeft ? left : above;
    const auto green = [&](const Texel& from) { return aligned(from.g, from.exponent, t.exponent); };
    int predicted = hasLeft ? green(left) : green(above);
    if (hasLeft && hasAbove)
      predicted = median(green(left), green(above), green(texelOf(texels[i - static_cast<size_t>(width) - 1])));
    t.g = nearby(t.g, predicted, slack);
    const int red = byRatio(t.g, beside.r, beside.g), blue = byRatio(t.g, beside.b, beside.g);
    t.r = nearby(t.r, red, slack);
    t.b = nearby(t.b, blue, slack);
    texels[i] = packed(t);  // those after it are predicted by what comes back
    const uint32_t g = folded(t.g - predicted, 9), r = folded(t.r - red, 9), b = folded(t.b - blue, 9),
                   e = folded(t.exponent - beside.exponent, 5);
    planes[i] = static_cast<char>(g), planes[count + i] = static_cast<char>(r);
    planes[2 * count + i] = static_cast<char>(b);
    planes[3 * count + i] = static_cast<char>(g >> 8 | r >> 8 << 1 | b >> 8 << 2 | e << 3);
  }
  return planes;
}

}  // namespace roomlight::bake
