// Bits of a stream, the lowest bit of each byte first.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "import/failure.h"

namespace roomlight::importers {

class BitReader {
 public:
  explicit BitReader(std::span<const uint8_t> bytes, size_t bit = 0) : bytes_(bytes), bit_(bit) {}

  uint32_t bit() {
    if (bit_ >= 8 * bytes_.size()) fail("", "the compressed data are cut short");
    const uint32_t v = (bytes_[bit_ / 8] >> (bit_ % 8)) & 1u;
    ++bit_;
    return v;
  }
  // Up to 32 bits. Throws Failure beyond the end.
  uint32_t bits(int count) {
    uint32_t v = 0;
    for (int i = 0; i < count; ++i) v |= bit() << i;
    return v;
  }

 private:
  std::span<const uint8_t> bytes_;
  size_t bit_;
};

}  // namespace roomlight::importers
