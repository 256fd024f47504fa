// SHA-1 (FIPS 180-4): what Sweet Home 3D writes of each content to notice damage. It guards against accidents, not
 // against malice.
#pragma once

#include <array>
#include <cstdint>
#include <span>

namespace roomlight::importers {

using Sha1Digest = std::array<uint8_t, 20>;

class Sha1 {
 public:
  void add(std::span<const uint8_t> bytes);
  Sha1Digest finish();  // once, at the end

 private:
  void block(const uint8_t* bytes);  // 64 of them

  std::array<uint32_t, 5> state_{0x67452301, 0xefcdab89, 0x98badcfe, 0x10325476, 0xc3d2e1f0};
  std::array<uint8_t, 64> waiting_{};
  size_t waitingBytes_ = 0;
  uint64_t allBytes_ = 0;
};

}  // namespace roomlight::importers
