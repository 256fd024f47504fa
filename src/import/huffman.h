// Canonical Huffman codes as Deflate has them (RFC 1951, section 3.2.2), the first bit of a code its highest.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "import/bit_reader.h"

namespace roomlight::importers {

constexpr size_t kLongestHuffmanCode = 16;

class HuffmanTable {
 public:
  HuffmanTable() = default;
  // The length of each symbol's code, 0: it has none. Throws Failure where the lengths are no prefix code.
  explicit HuffmanTable(std::span<const uint8_t> lengths);

  // The next symbol. Throws Failure where the bits are no code, or end.
  uint32_t next(BitReader& bits) const;

 private:
  std::array<uint32_t, kLongestHuffmanCode + 1> countOfLength_{};
  std::vector<uint16_t> symbols_;  // by length, then by number
};

}  // namespace roomlight::importers
