#include <numeric>

#include "base/parallel.h"
#include "voxel/lattice.h"
#include "voxel/voxelise.h"

namespace roomlight {
namespace {

constexpr double kBytesPerVoxel = 320;          // record, 1.7 slots, light on them and its share of the mips
constexpr double kVoxelsPerCrossSection = 1.6;  // voxels that a surface of one voxel's cross-section touches

// In double: the square of an absurd length would overflow a float.
double areaOfTriangle(Vec3 e1, Vec3 e2) {
  const double x1 = e1.x, y1 = e1.y, z1 = e1.z, x2 = e2.x, y2 = e2.y, z2 = e2.z;
  return 0.5 * std::hypot(y1 * z2 - z1 * y2, z1 * x2 - x1 * z2, x1 * y2 - y1 * x2);
}

}  // namespace

float chooseVoxelSize(const Scene& scene, const VoxelSettings& settings) {
  if (settings.voxelSizeM > 0) return settings.voxelSizeM;
  std::vector<double> areas(scene.instances.size(), 0);
  parallelFor(areas.size(), 4, [&](size_t i) {
    const Affine& m = scene.instances[i].worldFromObject;
    const Mesh& mesh = scene.meshes[static_cast<size_t>(scene.instances[i].mesh)];
    for (size_t t = 0; t + 2 < mesh.indices.size(); t += 3) {
      const Vec3 a = mesh.positions[mesh.indices[t]], b = mesh.positions[mesh.indices[t + 1]],
                 c = mesh.positions[mesh.indices[t + 2]];
      areas[i] += areaOfTriangle(m.vector(b - a), m.vector(c - a));
    }
  });
  const double area = std::accumulate(areas.begin(), areas.end(), 0.0);
  const double budget = settings.memoryBudgetMiB * 1048576.0;
  const double wanted = std::sqrt(area * kVoxelsPerCrossSection * kBytesPerVoxel / budget);
  double h = std::clamp(wanted, static_cast<double>(settings.smallestM), static_cast<double>(settings.largestM));
  // A small home on a huge ground plane: the memory may grow beyond the budget, but not without limit.
  h = std::max(h, wanted / 2) * static_cast<double>(settings.sizeFactor);
  return feasibleVoxelSizeM(scene.bounds(), static_cast<float>(h));
}

}  // namespace roomlight
