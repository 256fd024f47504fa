// The texels in a stream of light, as a reader unpacks them (docs/reference/baked.md).
#pragma once

#include <gtest/gtest.h>
#include <zlib.h>

#include <cstdint>
#include <string_view>
#include <vector>

namespace roomlight::bake {

inline std::vector<uint32_t> texelsOf(std::string_view stream, size_t count) {
  std::string planes(count * 4, '\0');
  uLongf size = planes.size();
  EXPECT_EQ(uncompress(reinterpret_cast<Bytef*>(planes.data()), &size, reinterpret_cast<const Bytef*>(stream.data()),
                       static_cast<uLong>(stream.size())),
            Z_OK);
  EXPECT_EQ(size, planes.size());
  std::vector<uint32_t> texels(count);
  for (size_t i = 0; i < count; ++i) {
    for (size_t k = 0; k < 4; ++k)
      texels[i] |= static_cast<uint32_t>(static_cast<uint8_t>(planes[k * count + i])) << (8 * k);
  }
  return texels;
}

}  // namespace roomlight::bake
