#include "voxel/lattice.h"

namespace roomlight {
namespace {

constexpr double kLargestGrid = 16e6;           // bricks in the dense index: 64 MiB
constexpr double kFarthestVoxel = 1 << 18;      // from the world's origin: a float then resolves 1/32 of a voxel

double firstBrickBelow(double lo, double h) { return std::floor((lo - h) / (h * kBrickSize)); }
double lastBrickAbove(double hi, double h) { return std::floor((hi + h) / (h * kBrickSize)); }

bool feasible(const Bounds3& bounds, double h) {
  double bricks = 1;
  for (int k = 0; k < 3; ++k) {
    const double lo = bounds.lo[k], hi = bounds.hi[k];
    if (std::max(std::abs(lo), std::abs(hi)) > kFarthestVoxel * h) return false;
    bricks *= lastBrickAbove(hi, h) - firstBrickBelow(lo, h) + 1;
  }
  return bricks <= kLargestGrid;
}

}  // namespace

Vec3 Lattice::originM() const {
  const double edge = static_cast<double>(voxelSizeM) * kBrickSize;
  return {static_cast<float>(firstBrick.x * edge), static_cast<float>(firstBrick.y * edge),
          static_cast<float>(firstBrick.z * edge)};
}

uint32_t Lattice::place(Int3 b) const {
  const int64_t x = b.x - firstBrick.x, y = b.y - firstBrick.y, z = b.z - firstBrick.z;
  return static_cast<uint32_t>((z * brickDims.y + y) * brickDims.x + x);
}

Int3 Lattice::brick(uint32_t place) const {
  const auto dx = static_cast<uint32_t>(brickDims.x), dy = static_cast<uint32_t>(brickDims.y);
  return brickOf({static_cast<int>(place % dx), static_cast<int>(place / dx % dy), static_cast<int>(place / dx / dy)});
}

bool Lattice::contains(Int3 b) const {
  const Int3 r{b.x - firstBrick.x, b.y - firstBrick.y, b.z - firstBrick.z};
  return r.x >= 0 && r.y >= 0 && r.z >= 0 && r.x < brickDims.x && r.y < brickDims.y && r.z < brickDims.z;
}

Lattice fitLattice(const Bounds3& bounds, float voxelSizeM) {
  Lattice lattice;
  lattice.voxelSizeM = voxelSizeM;
  if (bounds.empty() || !std::isfinite(voxelSizeM)) return lattice;
  const double h = voxelSizeM;
  const auto fit = [&](int axis, int& first, int& count) {
    first = static_cast<int>(firstBrickBelow(bounds.lo[axis], h));
    count = static_cast<int>(lastBrickAbove(bounds.hi[axis], h)) - first + 1;
  };
  fit(0, lattice.firstBrick.x, lattice.brickDims.x);
  fit(1, lattice.firstBrick.y, lattice.brickDims.y);
  fit(2, lattice.firstBrick.z, lattice.brickDims.z);
  return lattice;
}

Lattice latticeOf(const Voxels& voxels) {
  const double edge = static_cast<double>(voxels.voxelSizeM) * kBrickSize;
  const auto first = [&](float origin) { return edge > 0 ? static_cast<int>(std::lround(origin / edge)) : 0; };
  return {
      voxels.voxelSizeM, {first(voxels.origin.x), first(voxels.origin.y), first(voxels.origin.z)}, voxels.brickDims};
}

float feasibleVoxelSizeM(const Bounds3& bounds, float wantedM) {
  float h = wantedM;
  while (!bounds.empty() && std::isfinite(h) && !feasible(bounds, h)) h *= 1.1f;
  return h;
}

}  // namespace roomlight
