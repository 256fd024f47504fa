// The texels in a stream of light, as a reader unpacks them (docs/reference/baked.md).
#pragma once

#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace roomlight::bake {

// Tiles of `width` x `height` texels, `count` in all.
inline std::vector<uint32_t> texelsOf(std::string_view stream, size_t count, size_t width, size_t height) {
  std::string planes(count * 4, '\0');
  uLongf size = planes.size();
  EXPECT_EQ(uncompress(reinterpret_cast<Bytef*>(planes.data()), &size, reinterpret_cast<const Bytef*>(stream.data()),
                       static_cast<uLong>(stream.size())),
            Z_OK);
  EXPECT_EQ(size, planes.size());
  std::vector<uint32_t> texels(count);
  const auto part = [](uint32_t t, int c) { return static_cast<int>(c == 3 ? t >> 27 : t >> (9 * c) & 511); };
  for (size_t i = 0; i < count; ++i) {
    const size_t x = i % width, y = i / width % height;
    const auto unfolded = [&](size_t plane, int shift) {
      const auto last = static_cast<uint8_t>(planes[3 * count + i]);
      const int n = plane == 3 ? last >> 3 : static_cast<uint8_t>(planes[plane * count + i]) | (last >> shift & 1) << 8;
      return n % 2 ? -(n + 1) / 2 : n / 2;
    };
    const uint32_t left = x > 0 ? texels[i - 1] : 0, above = y > 0 ? texels[i - width] : 0,
                   beside = x > 0 ? left : above;
    const int e = (part(beside, 3) + unfolded(3, 0)) & 31;
    const auto green = [&](uint32_t t) {
      int m = part(t, 1);
      for (int k = part(t, 3); k > e; --k) m = std::min(2 * m, 511);
      for (int k = part(t, 3); k < e; ++k) m /= 2;
      return m;
    };
    int predicted = green(beside);
    if (x > 0 && y > 0) {
      const int w = green(left), n = green(above), corner = green(texels[i - width - 1]);
      // The middle of three, but for where the corner is outside of the other two.
      predicted = std::clamp(w + n - corner, std::min(w, n), std::max(w, n));
    }
    const int g = (predicted + unfolded(0, 0)) & 511;
    const auto channel = [&](int c, size_t plane, int shift) {
      const int besideGreen = part(beside, 1);
      const int p = besideGreen ? std::min((g * part(beside, c) + besideGreen / 2) / besideGreen, 511) : g;
      return static_cast<uint32_t>((p + unfolded(plane, shift)) & 511);
    };
    texels[i] =
        channel(0, 1, 1) | static_cast<uint32_t>(g) << 9 | channel(2, 2, 2) << 18 | static_cast<uint32_t>(e) << 27;
  }
  return texels;
}

}  // namespace roomlight::bake
