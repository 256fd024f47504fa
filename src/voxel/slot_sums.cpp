#include "voxel/slot_sums.h"

namespace roomlight {
namespace {

constexpr float kSameLayer = 1e-3f;   // voxels
constexpr float kLargeShare = 0.25f;  // of the largest piece so far: large enough to stand for its side
constexpr float kFull = 1.001f;       // a cross-section covered once, and rounding

}  // namespace

void SlotSums::add(const SlotPiece& piece, int face, std::vector<Layer>& layers) {
  if (piece.instance != instance_) instance_ = piece.instance, instanceArea_ = 0;
  instanceArea_ += piece.area;
  if (instanceArea_ > bestArea_) bestArea_ = instanceArea_, bestInstance_ = piece.instance;
  area_ += piece.area, wholeArea_ += piece.wholeArea, projected_ += piece.projected;
  const float z = dot(piece.place, faceDirection(face));
  const bool stands = z > height_ + kSameLayer   ? piece.area > kLargeShare * pieceArea_
                      : z < height_ - kSameLayer ? kLargeShare * piece.area > pieceArea_
                                                 : piece.area > pieceArea_;
  if (stands) pieceArea_ = piece.area, position_ = piece.place, height_ = z;
  normal_ += piece.normal * piece.area, albedo_ += piece.albedo * piece.area, emission_ += piece.emission * piece.area;
  layers.push_back({z, piece.projected, piece.area, piece.albedo, firstLayer_});
  firstLayer_ = static_cast<int32_t>(layers.size()) - 1;
}

// Surfaces that together cover the cross-section more than once hide one another: from the foremost back, each counts
// with what is left of the cross-section. So the two boards of a thin wall do not mix their colours.
Vec3 SlotSums::meanAlbedo(const std::vector<Layer>& layers) const {
  if (projected_ <= kFull) return albedo_ / area_;
  thread_local std::vector<int32_t> order;
  order.clear();
  for (int32_t i = firstLayer_; i >= 0; i = layers[static_cast<size_t>(i)].next) order.push_back(i);
  std::sort(order.begin(), order.end(), [&](int32_t a, int32_t b) {
    const float ha = layers[static_cast<size_t>(a)].height, hb = layers[static_cast<size_t>(b)].height;
    return ha != hb ? ha > hb : a < b;
  });
  float left = 1, sum = 0;
  Vec3 albedo;
  for (const int32_t i : order) {
    const Layer& layer = layers[static_cast<size_t>(i)];
    if (!(left > 0) || !(layer.projected > 0)) continue;
    const float seen = std::min(layer.projected, left) / layer.projected * layer.area;
    albedo += layer.albedo * seen, sum += seen;
    left -= layer.projected;
  }
  return sum > 0 ? albedo / sum : albedo_ / area_;
}

FaceSlot SlotSums::finish(int face, const Lattice& lattice, const std::vector<Layer>& layers) const {
  FaceSlot slot;
  slot.position = lattice.toWorld(position_);
  const float l = length(normal_);
  slot.normal = l > 1e-6f * area_ ? normal_ / l : faceDirection(face);
  slot.albedo = meanAlbedo(layers);
  slot.emission = emission_ / area_;
  slot.opacity = wholeArea_ > 0 ? std::min(1.0f, area_ / wholeArea_) : 1;
  slot.areaM2 = area_ * lattice.voxelSizeM * lattice.voxelSizeM;
  slot.instance = bestInstance_;
  slot.face = static_cast<uint8_t>(face);
  return slot;
}

}  // namespace roomlight
