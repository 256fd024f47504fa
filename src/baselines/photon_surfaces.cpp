#include "baselines/photon_surfaces.h"

#include <algorithm>

#include "base/sampling.h"
#include "baselines/photon_importance.h"
#include "trace/surface_point.h"
#include "voxel/voxels.h"

namespace roomlight {
namespace {

constexpr float kLongestM = 1.5f;
constexpr int kMostCuts = 5;  // a triangle has at most 4^5 pieces
// Of the light found in a cell so much counts there, the rest around it; and of all chances so much goes to places of
// use and to all places alike, whatever was found.
constexpr double kHere = 0.9, kOfUse = 0.05, kAnywhere = 0.01;

}  // namespace

SurfacePieces::SurfacePieces(const Scene& scene) {
  for (uint32_t i = 0; i < scene.instances.size(); ++i) {
    const Mesh& mesh = scene.meshes[static_cast<size_t>(scene.instances[i].mesh)];
    for (uint32_t t = 0; t < mesh.triangleCount(); ++t) {
      const TriangleVertices v = worldTriangle(scene, i, t);
      add(v.a, v.b, v.c, kMostCuts);
    }
  }
}

void SurfacePieces::add(Vec3 a, Vec3 b, Vec3 c, int cuts) {
  const float longest2 = std::max({lengthSquared(b - a), lengthSquared(c - b), lengthSquared(a - c)});
  if (cuts == 0 || longest2 <= kLongestM * kLongestM) {
    const float area = 0.5f * length(cross(b - a, c - a));
    if (area > 0) pieces_.push_back({a, b, c, area});
    return;
  }
  const Vec3 ab = (a + b) * 0.5f, bc = (b + c) * 0.5f, ca = (c + a) * 0.5f;
  add(a, ab, ca, cuts - 1), add(ab, b, bc, cuts - 1), add(ca, bc, c, cuts - 1), add(ab, bc, ca, cuts - 1);
}

PieceChoice::PieceChoice(const SurfacePieces& pieces, const PhotonImportance& importance,
                         const std::vector<Found>& found)
    : pieces_(&pieces) {
  struct Cell {
    double light = 0, areaM2 = 0;
  };
  std::unordered_map<uint64_t, Cell> cells;
  for (const Found& f : found) {
    const PhotonCell c = PhotonCell::of(f.p);
    for (int k = 0; k < 27; ++k)
      cells[c.around(k).key(dominantFace(f.n))].light +=
          static_cast<double>(f.light) * (k == 13 ? kHere : (1 - kHere) / 26);
  }
  const std::vector<SurfacePieces::Piece>& all = pieces.all();
  std::vector<uint64_t> keys(2 * all.size());
  double area = 0, areaOfUse = 0;
  for (size_t i = 0; i < all.size(); ++i) {
    const SurfacePieces::Piece& piece = all[i];
    const Vec3 middle = (piece.a + piece.b + piece.c) / 3, n = piece.normal();
    const PhotonCell c = PhotonCell::of(middle);
    keys[2 * i] = c.key(dominantFace(n)), keys[2 * i + 1] = c.key(dominantFace(-n));
    const double m2 = static_cast<double>(piece.areaM2);
    for (const size_t side : {2 * i, 2 * i + 1}) {
      if (const auto cell = cells.find(keys[side]); cell != cells.end()) cell->second.areaM2 += m2;
    }
    area += 2 * m2;
    if (importance.at(middle) > 0) areaOfUse += 2 * m2;
  }
  double light = 0;  // where there are pieces
  for (const auto& [key, cell] : cells) light += cell.areaM2 > 0 ? cell.light : 0;
  const double learned = light > 0 ? 1 - kOfUse - kAnywhere : 0, ofUse = areaOfUse > 0 ? kOfUse : 0;
  double sum = 0;
  upTo_.resize(keys.size());
  for (size_t side = 0; side < keys.size(); ++side) {
    const SurfacePieces::Piece& piece = all[side / 2];
    double perM2 = kAnywhere / area;
    if (ofUse > 0 && importance.at((piece.a + piece.b + piece.c) / 3) > 0) perM2 += ofUse / areaOfUse;
    if (const auto cell = cells.find(keys[side]); cell != cells.end() && learned > 0)
      perM2 += learned * cell->second.light / (light * cell->second.areaM2);
    upTo_[side] = sum += perM2 * static_cast<double>(piece.areaM2);
  }
  for (double& v : upTo_) v /= sum;
}

PieceChoice::Place PieceChoice::sample(double choice, Vec2 u) const {
  if (upTo_.empty()) return {};
  const size_t side = std::min(
      static_cast<size_t>(std::upper_bound(upTo_.begin(), upTo_.end(), choice) - upTo_.begin()), upTo_.size() - 1);
  const SurfacePieces::Piece& piece = pieces_->all()[side / 2];
  const Vec2 b = sampleTriangle(u);
  Place place;
  place.p = piece.a * (1 - b.x - b.y) + piece.b * b.x + piece.c * b.y;
  place.n = side % 2 == 0 ? piece.normal() : -piece.normal();
  place.pdf = static_cast<float>(upTo_[side] - (side ? upTo_[side - 1] : 0)) / piece.areaM2;
  return place;
}

}  // namespace roomlight
