#include "trace/emitter_pieces.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/sampling.h"
#include "base/simd.h"

namespace roomlight {
namespace {

constexpr float kPlaceM = 0.25f;    // spread of places that is as bad as one of normals by a radian
constexpr float kSmall = 0.04f;     // squared spread: a piece that has less is whole
constexpr float kLeastM2 = 1e-6f;
constexpr float kGrazing = 0.05f;   // of full light: what shines towards p at all is thought to give that much
constexpr float kSlack = 1e-3f;     // rad, for rounding

// Variance along each of six axes, of places in units of kPlaceM and of normals.
struct Spread {
  std::array<float, 6> mean{}, square{};
  float share = 0;
  static std::array<float, 6> of(const EmitterPieces::Part& part) {
    const Vec3 p = part.bounds.centre() / kPlaceM;
    return {p.x, p.y, p.z, part.normal.x, part.normal.y, part.normal.z};
  }
  void add(const EmitterPieces::Part& part, const std::array<float, 6>& about) {
    const auto at = of(part);
    for (size_t k = 0; k < 6; ++k)
      mean[k] += part.share * (at[k] - about[k]), square[k] += part.share * (at[k] - about[k]) * (at[k] - about[k]);
    share += part.share;
  }
  float variance(size_t k) const { return std::max(0.0f, square[k] / share - mean[k] * mean[k] / (share * share)); }
};

}  // namespace

EmitterPieces::EmitterPieces(std::span<const Part> parts, bool twice) : order_(parts.size()), twice_(twice) {
  std::iota(order_.begin(), order_.end(), 0u);
  if (parts.empty()) return;
  pieces_.push_back(pieceOf(parts, 0, static_cast<uint32_t>(parts.size())));
  for (size_t i = 0; i < pieces_.size() && pieces_.size() < kMost;) {
    if (!split(parts, i)) ++i;
  }
  pieceOf_.resize(parts.size());
  for (size_t k = 0; k < pieces_.size(); ++k) {
    const Piece& piece = pieces_[k];
    std::fill_n(pieceOf_.begin() + piece.first, piece.count, static_cast<uint8_t>(k));
    Lanes& l = lanes_;
    l.x[k] = piece.centre.x, l.y[k] = piece.centre.y, l.z[k] = piece.centre.z, l.axisX[k] = piece.axis.x,
    l.axisY[k] = piece.axis.y, l.axisZ[k] = piece.axis.z;
    l.radius2[k] = piece.radius2, l.cosHalf[k] = piece.cosHalf, l.sinHalf[k] = piece.sinHalf, l.share[k] = piece.share;
  }
}

EmitterPieces::Piece EmitterPieces::pieceOf(std::span<const Part> parts, uint32_t first, uint32_t count) const {
  Piece piece{};
  Bounds3 bounds;
  Vec3 axis;
  double share = 0;
  for (uint32_t i = first; i < first + count; ++i) {
    const Part& part = parts[order_[i]];
    bounds.add(part.bounds);
    axis += part.normal * part.share;
    share += static_cast<double>(part.share);
  }
  piece.share = static_cast<float>(share);
  piece.centre = bounds.centre(), piece.radius2 = 0.25f * lengthSquared(bounds.size());
  piece.first = first, piece.count = count;
  piece.axis = lengthSquared(axis) > 1e-12f * piece.share * piece.share ? normalize(axis) : parts[order_[first]].normal;
  float least = 1;
  for (uint32_t i = first; i < first + count; ++i) least = std::min(least, dot(parts[order_[i]].normal, piece.axis));
  const float half = std::min(kPi, std::acos(std::clamp(least, -1.0f, 1.0f)) + kSlack);
  piece.cosHalf = std::cos(half), piece.sinHalf = std::sin(half);
  return piece;
}

// In two of like flux along the axis on which its places or normals differ most.
bool EmitterPieces::split(std::span<const Part> parts, size_t which) {
  const Piece whole = pieces_[which];
  if (whole.count < 2) return false;
  Spread spread;
  const auto about = Spread::of(parts[order_[whole.first]]);
  for (uint32_t i = whole.first; i < whole.first + whole.count; ++i) spread.add(parts[order_[i]], about);
  size_t axis = 0;
  for (size_t k = 1; k < (twice_ ? 3u : 6u); ++k) {
    if (spread.variance(k) > spread.variance(axis)) axis = k;
  }
  if (spread.variance(axis) < kSmall) return false;
  const auto begin = order_.begin() + whole.first, end = begin + whole.count;
  std::sort(begin, end, [&](uint32_t a, uint32_t b) {
    const float x = Spread::of(parts[a])[axis], y = Spread::of(parts[b])[axis];
    return x < y || (x == y && a < b);
  });
  uint32_t left = 0;
  for (double sum = 0; left < whole.count - 1 && (left == 0 || sum < 0.5 * static_cast<double>(whole.share)); ++left)
    sum += static_cast<double>(parts[begin[left]].share);
  pieces_[which] = pieceOf(parts, whole.first, left);
  pieces_.push_back(pieceOf(parts, whole.first + left, whole.count - left));
  return true;
}

// 0 only where none of a piece shines towards p.
EmitterPieces::Weights EmitterPieces::weights(Vec3 p) const {
  Weights out;
  if (pieces_.size() == 1) return out;
  const Lanes& l = lanes_;
  Float4 sum;
  for (size_t i = 0; i < pieces_.size(); i += 4) {
    const auto lane = [i](const std::array<float, kMost>& of) { return Float4::load(of.data() + i); };
    const Float4 dx = Float4(p.x) - lane(l.x), dy = Float4(p.y) - lane(l.y), dz = Float4(p.z) - lane(l.z),
                 radius2 = lane(l.radius2);
    const Float4 one(1), zero, d2 = dx * dx + dy * dy + dz * dz, nearest2 = max(d2, radius2 + Float4(kLeastM2));
    Float4 shines(1);
    if (!twice_) {
      // The angle to the axis less that of the normals and that under which the piece is seen.
      const Float4 far2 = max(d2, radius2 + Float4(kLeastM2)), seen2 = radius2 / far2;
      const Float4 cosine = (dx * lane(l.axisX) + dy * lane(l.axisY) + dz * lane(l.axisZ)) / sqrt(far2),
                   sine = sqrt(max(zero, one - cosine * cosine));
      const Float4 sinSeen = sqrt(seen2), cosSeen = sqrt(one - seen2), cosHalf = lane(l.cosHalf),
                   sinHalf = lane(l.sinHalf);
      const Float4 cosOff = cosHalf * cosSeen - sinHalf * sinSeen, sinOff = sinHalf * cosSeen + cosHalf * sinSeen;
      // sinOff below 0: more than half a turn. Among its places all are taken to shine.
      const Float4 all = (sinOff < zero) | (cosOff <= cosine) | (d2 <= radius2 * Float4(1.0001f) + Float4(kLeastM2));
      const Float4 best = select(all, one, cosine * cosOff + sine * sinOff);
      shines = select(zero < best, best + Float4(kGrazing), zero);
    }
    const Float4 weight = lane(l.share) * shines / nearest2;
    weight.store(out.own.data() + i);
    sum = sum + weight;
  }
  out.sum = dot(sum, Float4(1));
  return out;
}

EmitterPieces::Choice EmitterPieces::choose(const Weights& weights, float u) const {
  if (pieces_.size() == 1) return {0, pieces_[0].count, 1, pieces_[0].share, u};
  if (!(weights.sum > 0)) return {};
  const size_t chosen = chooseByWeight(
      pieces_.size(), weights.sum, [&](size_t i) { return weights.own[i]; }, u);
  const Piece& piece = pieces_[chosen];
  return {piece.first, piece.count, weights.own[chosen] / weights.sum, piece.share, u};
}

float EmitterPieces::chanceOverShare(uint32_t part, Vec3 p) const {
  const size_t k = pieceOf_[part];
  if (pieces_.size() == 1) return 1 / pieces_[0].share;
  const Weights of = weights(p);
  return of.sum > 0 ? of.own[k] / (of.sum * pieces_[k].share) : 0;
}

}  // namespace roomlight
