// Space in cells of a metre, told by a number.
#pragma once

#include <cmath>
#include <cstdint>

#include "base/random.h"
#include "base/vec.h"

namespace roomlight {

struct PhotonCell {
  int64_t x, y, z;

  static PhotonCell of(Vec3 p) {
    const auto whole = [](float v) { return static_cast<int64_t>(std::floor(v)); };
    return {whole(p.x), whole(p.y), whole(p.z)};
  }
  // Number k of 27: itself (13) and those around it.
  PhotonCell around(int k) const { return {x + k % 3 - 1, y + k / 3 % 3 - 1, z + k / 9 - 1}; }
  uint64_t key() const {
    const auto part = [](int64_t v) { return static_cast<uint64_t>(v + (1 << 20)) & 0x1fffffu; };
    return part(x) | part(y) << 21 | part(z) << 42;
  }
  // Of what looks the way of `face` there.
  uint64_t key(int face) const { return mix64(key() * 8 + static_cast<uint64_t>(face)); }
};

}  // namespace roomlight
