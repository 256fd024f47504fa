#include "bake/simplify.h"

#include <meshoptimizer.h>

#include <algorithm>

#include "base/parallel.h"

namespace roomlight::bake {
namespace {

constexpr size_t kFewTriangles = 64;

float largestStretch(const Affine& a) { return std::max({length(a.x), length(a.y), length(a.z)}); }

}  // namespace

void simplifyMeshes(Scene& scene, float errorM) {
  std::vector<float> stretch(scene.meshes.size(), 0);
  for (const Instance& instance : scene.instances) {
    float& s = stretch[static_cast<size_t>(instance.mesh)];
    s = std::max(s, largestStretch(instance.worldFromObject));
  }
  parallelFor(scene.meshes.size(), 1, [&](size_t i) {
    Mesh& mesh = scene.meshes[i];
    if (mesh.material >= 0 && !isBlack(scene.materials[static_cast<size_t>(mesh.material)].emission)) return;
    if (mesh.triangleCount() < kFewTriangles || !(stretch[i] > 0)) return;
    const float* positions = &mesh.positions.front().x;
    const float scale = meshopt_simplifyScale(positions, mesh.positions.size(), sizeof(Vec3));
    if (!(scale > 0)) return;
    std::vector<uint32_t> indices(mesh.indices.size());
    const size_t count =
        meshopt_simplify(indices.data(), mesh.indices.data(), mesh.indices.size(), positions, mesh.positions.size(),
                         sizeof(Vec3), 0, errorM / (stretch[i] * scale), 0, nullptr);
    if (count == 0) return;  // a thing as small as the error stays as it is
    indices.resize(count);
    mesh.indices = std::move(indices);
  });
}

}  // namespace roomlight::bake
