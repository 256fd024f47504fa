// Hashes that notice changes of what a run depends on; no protection against intent.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

namespace roomlight {

// 64 bits: FNV-1a by words of eight bytes. Multiplying carries a change only upwards, so the upper half is folded into
// the lower. Each step can be undone: a change within one word never goes unnoticed.
class Hash {
 public:
  void word(uint64_t value) {
    h_ = (h_ ^ value) * 0x100000001b3ull;
    h_ ^= h_ >> 32;
  }
  // With their number, so that what follows cannot be taken for a part of them.
  void bytes(std::string_view bytes) {
    word(bytes.size());
    for (; !bytes.empty(); bytes.remove_prefix(std::min(bytes.size(), sizeof(uint64_t)))) {
      uint64_t value = 0;
      std::memcpy(&value, bytes.data(), std::min(bytes.size(), sizeof(value)));
      word(value);
    }
  }
  std::string text() const { return fmt::format("{:016x}", h_); }

 private:
  uint64_t h_ = 0xcbf29ce484222325ull;
};

// Of a text, as Hash::text().
inline std::string hashOf(std::string_view text) {
  Hash hash;
  hash.bytes(text);
  return hash.text();
}

}  // namespace roomlight
