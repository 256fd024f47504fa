// Where the rays went that slots asked the sky for light with: kept, so that after a move only those that it concerns
// are found without choosing all directions anew.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/vec.h"

namespace roomlight {

constexpr uint32_t kSkySamples = 8;  // a slot

// A unit direction in 16 bits: a cell of an octahedron unfolded. None at all is one of the codes.
class SkyDirection {
 public:
  // So far a direction, times its length, may lie beside that of its cell.
  static constexpr float kOff = 0.02f;
  SkyDirection() = default;
  explicit SkyDirection(Vec3 d);
  Vec3 direction() const;  // unit; zero: none

 private:
  static constexpr uint16_t kNone = 0xffff;
  uint16_t code_ = kNone;
};

using SkyDirections = std::vector<std::array<SkyDirection, kSkySamples>>;  // per slot

}  // namespace roomlight
