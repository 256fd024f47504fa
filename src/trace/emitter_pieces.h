// An emissive mesh in a few pieces, of which those are chosen that shine towards a place: of a globe the near half, of
 // a strip what lies near.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/vec.h"

namespace roomlight {

class EmitterPieces {
 public:
  static constexpr uint32_t kMost = 16;
  struct Part {  // a triangle
    Bounds3 bounds;  // m
    Vec3 normal;     // unit, of the front
    float share;     // of the mesh's flux
  };
  struct Choice {
    uint32_t first = 0, count = 0;  // parts, by their place in order()
    float chance = 0;               // 0: none of them shines towards p
    float share = 0;                // of the mesh's flux
    float rest = 0;                 // what is left of u, rescaled to [0, 1)
  };

  EmitterPieces() = default;
  // `twice`: shines to both sides.
  EmitterPieces(std::span<const Part> parts, bool twice);
  // Parts by piece: the numbers they had.
  const std::vector<uint32_t>& order() const { return order_; }
  // What each could give a place without shadows; where there is one alone that is not asked.
  struct Weights {
    std::array<float, kMost> own;
    float sum = 1;
  };
  Weights weights(Vec3 p) const;
  // One piece by them, `u` in [0, 1).
  Choice choose(const Weights& weights, float u) const;
  // Chance with which choose(p) chooses the piece of a part over the piece's share of the flux. `part`: its place in
// order().
  float chanceOverShare(uint32_t part, Vec3 p) const;

 private:
  struct Piece {
    Vec3 centre, axis;
    float radius2, share;
    float cosHalf, sinHalf;  // all normals lie within that angle of the axis
    uint32_t first, count;
  };
  Piece pieceOf(std::span<const Part> parts, uint32_t first, uint32_t count) const;
  bool split(std::span<const Part> parts, size_t which);

  // The same, one array a quantity; pieces that are not there have no share.
  struct Lanes {
    std::array<float, kMost> x{}, y{}, z{}, axisX{}, axisY{}, axisZ{}, radius2{}, cosHalf{}, sinHalf{}, share{};
  };
  std::vector<Piece> pieces_;
  Lanes lanes_;
  std::vector<uint32_t> order_;
  std::vector<uint8_t> pieceOf_;  // by place in order_
  bool twice_ = false;
};

}  // namespace roomlight
