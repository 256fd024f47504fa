#include "baselines/lpv_geometry.h"

#include "base/parallel.h"
#include "baselines/lpv_grid.h"

namespace roomlight {
namespace {

// A clamped cosine in four harmonics is a quarter and half the cosine.
float stopped(float area, Vec3 normal, Vec3 d) { return std::clamp(0.25f * area - 0.5f * dot(normal, d), 0.0f, 1.0f); }

}  // namespace

LpvLattice latticeAround(const Bounds3& box, int cells, float smallestM) {
  LpvLattice out;
  const Vec3 size = box.size();
  out.cellM = std::max(smallestM, maxComponent(size) / static_cast<float>(cells - 2));
  const auto along = [&](float s) {
    return std::clamp(static_cast<int>(std::ceil(s / out.cellM - 1e-3f)) + 2, 3, cells);
  };
  out.cells = {along(size.x), along(size.y), along(size.z)};
  out.corner = box.centre() -
               Vec3{static_cast<float>(out.cells.x), static_cast<float>(out.cells.y), static_cast<float>(out.cells.z)} *
                   (0.5f * out.cellM);
  return out;
}

LpvGeometry::LpvGeometry(const LpvLattice& lattice, std::span<const Surfel> surfels) : lattice_(lattice) {
  const Int3 n = lattice.cells;
  corners_.resize(static_cast<size_t>(n.x + 1) * static_cast<size_t>(n.y + 1) * static_cast<size_t>(n.z + 1));
  const float perSide = 1 / (lattice.cellM * lattice.cellM);
  for (const Surfel& s : surfels) {
    const Vec3 q = lattice.local(s.p) + Vec3(0.5f);
    const Int3 c{static_cast<int>(std::floor(q.x)), static_cast<int>(std::floor(q.y)),
                 static_cast<int>(std::floor(q.z))};
    if (c.x < 0 || c.y < 0 || c.z < 0 || c.x > n.x || c.y > n.y || c.z > n.z) continue;
    Corner& corner = corners_[cornerIndex(c)][static_cast<size_t>(dominantFace(s.n))];
    const float area = s.areaM2 * perSide;
    corner.area += area;
    corner.normal += s.n * area;
    corner.albedo += s.albedo * area;
  }
  passes_.assign(static_cast<size_t>(kLpvWalls) * lattice.paddedCount(), 1);
  std::vector<std::vector<Mirror>> layers(static_cast<size_t>(n.z + 2));
  parallelFor(layers.size(), 1, [&](size_t z) {
    for (int y = 0; y < n.y + 2; ++y) {
      for (int x = 0; x < n.x + 2; ++x) {
        for (int side = 0; side < 6; ++side) meet({x, y, static_cast<int>(z)}, side, layers[z]);
      }
    }
  });
  for (const std::vector<Mirror>& layer : layers) {
    firstMirror_.push_back(mirrors_.size());
    mirrors_.insert(mirrors_.end(), layer.begin(), layer.end());
  }
  firstMirror_.push_back(mirrors_.size());
}

std::span<const LpvGeometry::Mirror> LpvGeometry::mirrors(int z) const {
  if (mirrors_.empty()) return {};
  const auto layer = static_cast<size_t>(z);
  return std::span(mirrors_).subspan(firstMirror_[layer], firstMirror_[layer + 1] - firstMirror_[layer]);
}

// q: in cells from the corner of the lattice, which is where corners are counted from too.
std::array<LpvGeometry::Corner, 6> LpvGeometry::between(Vec3 q) const {
  const Int3 n = lattice_.cells;
  const auto low = [](float v, int most) { return std::clamp(static_cast<int>(std::floor(v)), 0, most - 1); };
  const Int3 c{low(q.x, n.x), low(q.y, n.y), low(q.z, n.z)};
  const auto part = [](float v, int from) { return std::clamp(v - static_cast<float>(from), 0.0f, 1.0f); };
  const Vec3 f{part(q.x, c.x), part(q.y, c.y), part(q.z, c.z)};
  std::array<Corner, 6> out;
  for (int i = 0; i < 8; ++i) {
    const float w = (i & 1 ? f.x : 1 - f.x) * (i & 2 ? f.y : 1 - f.y) * (i & 4 ? f.z : 1 - f.z);
    if (w == 0) continue;
    const std::array<Corner, 6>& corner = corners_[cornerIndex({c.x + (i & 1), c.y + ((i >> 1) & 1), c.z + (i >> 2)})];
    for (size_t face = 0; face < 6; ++face) {
      out[face].area += corner[face].area * w;
      out[face].normal += corner[face].normal * w;
      out[face].albedo += corner[face].albedo * w;
    }
  }
  return out;
}

float LpvGeometry::passes(Vec3 p, Vec3 d) const {
  if (empty()) return 1;
  float most = 0;
  for (const Corner& c : between(lattice_.local(p))) most = std::max(most, stopped(c.area, c.normal, d));
  return 1 - most;
}

// Between a cell and its neighbour: in the middle of the side that they share.
void LpvGeometry::meet(Int3 cell, int side, std::vector<Mirror>& mirrors) {
  const Vec3 to = faceDirection(side);
  if (!lattice_.contains(
          {cell.x + static_cast<int>(to.x), cell.y + static_cast<int>(to.y), cell.z + static_cast<int>(to.z)}))
    return;
  const std::array<Corner, 6> here = between(lattice_.local(lattice_.centre(cell) + to * (0.5f * lattice_.cellM)));
  const size_t index = lattice_.index(cell);
  std::array<float, 6> by{};
  for (int i = 5 * side; i < 5 * side + 5; ++i) {
    const LpvWall& wall = lpvWalls()[static_cast<size_t>(i)];
    float most = 0;
    size_t which = 0;
    for (size_t f = 0; f < 6; ++f) {
      if (const float s = stopped(here[f].area, here[f].normal, wall.direction); s > most) most = s, which = f;
    }
    passes_[static_cast<size_t>(i) * lattice_.paddedCount() + index] = 1 - most;
    by[which] += most;
  }
  const auto which = static_cast<size_t>(std::max_element(by.begin(), by.end()) - by.begin());
  if (by[which] == 0 || lattice_.isBorder(cell)) return;
  const Vec3 n = here[which].normal;
  mirrors.push_back({static_cast<uint32_t>(index), side, lengthSquared(n) > 0 ? normalize(n) : -to,
                     here[which].albedo / here[which].area});
}

}  // namespace roomlight
