// Running sums of the surfaces on one side of a voxel, and the slot they make.
#pragma once

#include <vector>

#include "voxel/lattice.h"

namespace roomlight {

// One piece of surface as the slot's side sees it.
struct SlotPiece {
  float area = 0;       // opaque, voxels²
  float wholeArea = 0;  // with what lets light through
  float projected = 0;  // the same, seen along the side's axis
  Vec3 place, normal;   // place: a point of it, by the centre
  Vec3 albedo, emission;
  uint32_t instance = 0;
};

// Pieces of a brick's slots that may hide one another, in lists.
struct Layer {
  float height, projected, area;  // voxels along the side's axis, voxels²
  Vec3 albedo;
  int32_t next;
};

class SlotSums {
 public:
  void add(const SlotPiece& piece, int face, std::vector<Layer>& layers);
  bool empty() const { return !(area_ > 1e-6f); }
  FaceSlot finish(int face, const Lattice& lattice, const std::vector<Layer>& layers) const;

 private:
  Vec3 meanAlbedo(const std::vector<Layer>& layers) const;

  float area_ = 0, wholeArea_ = 0, projected_ = 0;
  Vec3 normal_, albedo_, emission_;
  // Centroid of one piece, so that it really lies on a surface: of the foremost among the large ones. Light reaches the
  // front of a panel on a wall, not the plaster behind it, though both may lie in one voxel.
  Vec3 position_;
  float pieceArea_ = 0, height_ = 0;
  // Pieces come in order of instances, so the largest is known when the run of one instance ends.
  uint32_t instance_ = 0, bestInstance_ = 0;
  float instanceArea_ = 0, bestArea_ = 0;
  int32_t firstLayer_ = -1;
};

}  // namespace roomlight
