// Surfaces cut into pieces of about a metre, to start photons of suns and the sky on: where their light arrives first
// is chosen, then the direction it comes from. So windows need not be found from outside.
#pragma once

#include <unordered_map>
#include <vector>

#include "baselines/photon_importance.h"

namespace roomlight {

class SurfacePieces {
 public:
  explicit SurfacePieces(const Scene& scene);
  struct Piece {
    Vec3 a, b, c;  // world
    float areaM2;
    Vec3 normal() const { return normalize(cross(b - a, c - a)); }
  };
  const std::vector<Piece>& all() const { return pieces_; }

 private:
  void add(Vec3 a, Vec3 b, Vec3 c, int cuts);
  std::vector<Piece> pieces_;
};

// Chooses sides of pieces by the light that probes found there.
class PieceChoice {
 public:
  struct Found {
    Vec3 p, n;
    float light;  // in any unit
  };
  PieceChoice(const SurfacePieces& pieces, const PhotonImportance& importance, const std::vector<Found>& found);
  struct Place {
    Vec3 p, n;
    float pdf = 0;  // per m², of this side
  };
  Place sample(double choice, Vec2 u) const;

 private:
  const SurfacePieces* pieces_;
  std::vector<double> upTo_;  // sums of chances; two sides of each piece. Millions of them, some of a billionth
};

}  // namespace roomlight
