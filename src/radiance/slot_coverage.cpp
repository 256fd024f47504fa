#include "radiance/slot_coverage.h"

#include <cmath>

#include "base/parallel.h"

namespace roomlight {

// The volume of the cube below the plane is a sum over its corners of cubes of clipped heights; the area is its derivative:
// |n| / (2 n1 n2 n3) * sum over corners v of (-1)^(v1+v2+v3) max(0, offset - n.v)^2, for n with positive components.
double planeAreaInUnitCube(Vec3 normal, double offset) {
  double n[3], length = 0;
  for (int k = 0; k < 3; ++k) {
    n[k] = std::abs(static_cast<double>(normal[k]));
    if (normal[k] < 0) offset += n[k];  // the cube mirrored along k
    n[k] = std::max(n[k], 1e-3);        // keeps the quotient finite; moves the plane by less than a thousandth
    length += n[k] * n[k];
  }
  double sum = 0;
  for (int corner = 0; corner < 8; ++corner) {
    double below = offset;
    for (int k = 0; k < 3; ++k) below -= (corner >> k) & 1 ? n[k] : 0;
    if (below > 0) sum += (std::popcount(static_cast<unsigned>(corner)) & 1 ? -1 : 1) * below * below;
  }
  return std::max(0.0, std::sqrt(length) * sum / (2 * n[0] * n[1] * n[2]));
}

std::vector<uint8_t> slotCoverage(const Voxels& voxels) {
  std::vector<uint8_t> coverage(voxels.slots.size());
  const float h = voxels.voxelSizeM;
  parallelFor(voxels.bricks.size(), 8, [&](size_t b) {
    const Brick& brick = voxels.bricks[b];
    size_t record = brick.firstVoxel;
    for (int z = 0; z < kBrickSize; ++z) {
      for (uint64_t bits = brick.occupied[static_cast<size_t>(z)]; bits; bits &= bits - 1, ++record) {
        const int bit = std::countr_zero(bits);
        const Vec3 corner = voxels.origin + Vec3{static_cast<float>(brick.coord.x * kBrickSize + (bit & 7)), static_cast<float>(brick.coord.y * kBrickSize + (bit >> 3)),
                                                 static_cast<float>(brick.coord.z * kBrickSize + z)} * h;
        const SurfaceVoxel& voxel = voxels.voxels[record];
        const size_t end = voxel.firstSlot + static_cast<size_t>(std::popcount(static_cast<unsigned>(voxel.faces)));
        for (size_t s = voxel.firstSlot; s < end; ++s) {
          const FaceSlot& slot = voxels.slots[s];
          const double plane = planeAreaInUnitCube(slot.normal, dot(slot.normal, slot.position - corner) / h);
          const double share = slot.areaM2 / (static_cast<double>(h) * h * std::max(plane, 1e-3));
          coverage[s] = static_cast<uint8_t>(std::lround(255 * std::min(1.0, share)));
        }
      }
    }
  });
  return coverage;
}

}  // namespace roomlight
