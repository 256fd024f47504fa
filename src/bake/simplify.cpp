#include "bake/simplify.h"

#include <meshoptimizer.h>

#include <algorithm>

#include "base/parallel.h"

namespace roomlight::bake {
namespace {

constexpr size_t kFewTriangles = 64;

constexpr float kOfThickness = 0.02f;  // of its thickness a mesh may be off: planks, tiles and rugs lie on other things
constexpr float kLuminaireM = 0.03f;  // what is so near to a light source is part of a luminaire

bool shines(const Scene& scene, const Mesh& mesh) {
  return mesh.material >= 0 && !isBlack(scene.materials[static_cast<size_t>(mesh.material)].emission);
}

bool meet(const Bounds3& a, const Bounds3& b) {
  return maxComponent(a.lo - b.hi) <= 0 && maxComponent(b.lo - a.hi) <= 0;
}

// Of each mesh, whether one of its copies is part of a luminaire: a bulb, which would lose flux with its area, its
// shade, a profile, or what hides it. Of millimetres there depends how much light gets out, and where to.
std::vector<bool> partsOfLuminaires(const Scene& scene) {
  std::vector<Bounds3> sources;
  const auto add = [&](Bounds3 b) {
    if (!b.empty()) sources.push_back({b.lo - Vec3(kLuminaireM), b.hi + Vec3(kLuminaireM)});
  };
  for (const Instance& i : scene.instances) {
    if (shines(scene, scene.meshes[static_cast<size_t>(i.mesh)])) add(instanceBounds(scene, i));
  }
  for (const Lamp& lamp : scene.lamps) add({lamp.position, lamp.position});
  std::vector<bool> out(scene.meshes.size());
  for (const Instance& i : scene.instances) {
    const auto mesh = static_cast<size_t>(i.mesh);
    if (out[mesh] || scene.meshes[mesh].triangleCount() < kFewTriangles) continue;
    const Bounds3 bounds = instanceBounds(scene, i);
    out[mesh] = std::any_of(sources.begin(), sources.end(), [&](const Bounds3& s) { return meet(s, bounds); });
  }
  return out;
}

// The smallest extent of each mesh as it is placed.
std::vector<float> thicknesses(const Scene& scene) {
  std::vector<float> out(scene.meshes.size(), kInfinity);
  for (const Instance& i : scene.instances) {
    const Vec3 size = instanceBounds(scene, i).size();
    float& thickness = out[static_cast<size_t>(i.mesh)];
    thickness = std::min({thickness, size.x, size.y, size.z});
  }
  return out;
}

float largestStretch(const Affine& a) { return std::max({length(a.x), length(a.y), length(a.z)}); }

}  // namespace

void simplifyMeshes(Scene& scene, float errorM) {
  std::vector<float> stretch(scene.meshes.size(), 0);
  for (const Instance& instance : scene.instances) {
    float& s = stretch[static_cast<size_t>(instance.mesh)];
    s = std::max(s, largestStretch(instance.worldFromObject));
  }
  const std::vector<bool> kept = partsOfLuminaires(scene);
  const std::vector<float> thickness = thicknesses(scene);
  parallelFor(scene.meshes.size(), 1, [&](size_t i) {
    Mesh& mesh = scene.meshes[i];
    if (mesh.triangleCount() < kFewTriangles || !(stretch[i] > 0) || kept[i]) return;
    const float* positions = &mesh.positions.front().x;
    const float scale = meshopt_simplifyScale(positions, mesh.positions.size(), sizeof(Vec3));
    if (!(scale > 0)) return;
    const float most = std::min(errorM, kOfThickness * thickness[i]);
    std::vector<uint32_t> indices(mesh.indices.size());
    const size_t count =
        meshopt_simplify(indices.data(), mesh.indices.data(), mesh.indices.size(), positions, mesh.positions.size(),
                         sizeof(Vec3), 0, most / (stretch[i] * scale), 0, nullptr);
    if (count == 0) return;  // a thing as small as the error stays as it is
    indices.resize(count);
    mesh.indices = std::move(indices);
  });
}

}  // namespace roomlight::bake
