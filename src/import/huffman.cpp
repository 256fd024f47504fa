#include "import/huffman.h"

namespace roomlight::importers {

HuffmanTable::HuffmanTable(std::span<const uint8_t> lengths) {
  for (const uint8_t length : lengths) {
    if (length > kLongestHuffmanCode) fail("", "the compressed data are damaged: a code is too long");
    ++countOfLength_[length];
  }
  countOfLength_[0] = 0;
  std::array<uint32_t, kLongestHuffmanCode + 2> start{};
  int64_t free = 1;  // codes of this length that are not taken
  for (size_t length = 1; length <= kLongestHuffmanCode; ++length) {
    free = 2 * free - countOfLength_[length];
    if (free < 0) fail("", "the compressed data are damaged: more codes than there can be");
    start[length + 1] = start[length] + countOfLength_[length];
  }
  symbols_.resize(start[kLongestHuffmanCode + 1]);
  for (size_t symbol = 0; symbol < lengths.size(); ++symbol) {
    if (lengths[symbol] > 0) symbols_[start[lengths[symbol]]++] = static_cast<uint16_t>(symbol);
  }
}

uint32_t HuffmanTable::next(BitReader& bits) const {
  uint32_t code = 0, first = 0, index = 0;  // first: the first code of this length; index: of its symbol
  for (size_t length = 1; length <= kLongestHuffmanCode; ++length) {
    code |= bits.bit();
    const uint32_t count = countOfLength_[length];
    if (code - first < count) return symbols_[index + code - first];
    index += count;
    first = (first + count) << 1;
    code <<= 1;
  }
  fail("", "the compressed data are damaged: no such code");
}

}  // namespace roomlight::importers
