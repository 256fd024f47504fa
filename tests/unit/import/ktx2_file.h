// Builds small KTX2 pictures for tests: plain, UASTC from blocks written bit by bit, and BasisLZ.
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace roomlight::testing {

// Bits into bytes, the lowest first.
class BitWriter {
 public:
  std::string bytes;

  BitWriter& put(uint32_t value, int count) {
    for (int i = 0; i < count; ++i, ++at_) {
      if (at_ % 8 == 0) bytes += '\0';
      bytes.back() = static_cast<char>(bytes.back() | static_cast<char>(((value >> i) & 1u) << (at_ % 8)));
    }
    return *this;
  }
  // A Huffman code, the highest bit first.
  BitWriter& code(uint32_t value, int count) {
    for (int i = count - 1; i >= 0; --i) put(value >> i, 1);
    return *this;
  }
  // A table in which each of `symbols` has the code that is its own number, `length` bits long.
  BitWriter& table(uint32_t symbols, int length) {
    put(symbols, 14).put(21, 5);
    for (int i = 0; i < 21; ++i) put(5, 3);
    for (uint32_t i = 0; i < symbols; ++i) code(static_cast<uint32_t>(length), 5);
    return *this;
  }
  // A UASTC block's mode, and its hints left out.
  BitWriter& mode(uint32_t code, int codeBits, int hintBits) { return put(code, codeBits).put(0, hintBits); }
  std::string block() const {
    std::string full = bytes;
    full.resize(16);
    return full;
  }

 private:
  size_t at_ = 0;
};

struct Ktx2File {
  uint32_t format = 0, width = 4, height = 4, scheme = 0;
  uint8_t model = 166;
  std::string level = {}, global = {};

  std::string bytes() const {
    std::string out("\xabKTX 20\xbb\r\n\x1a\n", 12);
    const auto word = [&](uint64_t v, size_t size = 4) { out.append(reinterpret_cast<const char*>(&v), size); };
    const uint32_t descriptorAt = 104, descriptorBytes = 44, globalAt = descriptorAt + descriptorBytes;
    for (const uint32_t v : {format, 1u, width, height, 0u, 0u, 1u, 1u, scheme, descriptorAt, descriptorBytes, 0u, 0u})
      word(v);
    word(global.empty() ? 0 : globalAt, 8), word(global.size(), 8);
    word(globalAt + global.size(), 8), word(level.size(), 8), word(level.size(), 8);
    std::string descriptor(descriptorBytes, '\0');
    descriptor[0] = static_cast<char>(descriptorBytes), descriptor[12] = static_cast<char>(model);
    return out + descriptor + global + level;
  }
};

// 8 x 8 texels of four blocks: two endpoints, two selectors, every way to name them, and an alpha slice of the same
// blocks.
inline Ktx2File basisLzPicture() {
  BitWriter endpoints, selectors, tables, slice;
  endpoints.table(32, 5).table(32, 5).table(32, 5).table(8, 3).put(0, 1);
  endpoints.code(1, 3).code(0, 5).code(4, 5).code(8, 5);      // modifiers 1; 16, 20, 24
  endpoints.code(2, 3).code(16, 5).code(28, 5).code(31, 5);   // modifiers 3; 0, 16, 23
  selectors.put(0, 2).put(1, 1);
  for (const uint32_t row : {0xe4u, 0xe4u, 0xe4u, 0xe4u, 0x00u, 0x55u, 0xaau, 0xffu}) selectors.put(row, 8);
  tables.table(257, 9).table(2, 1).table(7, 3).table(64, 6).put(4, 13);
  slice.code(3 | 0 << 2 | 1 << 4 | 2 << 6, 9);  // endpoints: told, left, above, above and left
  slice.code(1, 1).code(1, 3);                  // endpoint 1; selector 1
  slice.code(4, 3);                             // selector 1 again, from the history
  slice.code(6, 3).code(0, 6);                  // a run of the history's first, selector 0
  Ktx2File f;
  f.width = f.height = 8, f.scheme = 1, f.model = 163;
  f.level = slice.bytes + slice.bytes;
  const auto word = [&](size_t v, size_t size = 4) { f.global.append(reinterpret_cast<const char*>(&v), size); };
  word(2, 2), word(2, 2), word(endpoints.bytes.size()), word(selectors.bytes.size()), word(tables.bytes.size()),
      word(0);
  word(0), word(0), word(slice.bytes.size()), word(slice.bytes.size()), word(slice.bytes.size());
  f.global += endpoints.bytes + selectors.bytes + tables.bytes;
  return f;
}

}  // namespace roomlight::testing
