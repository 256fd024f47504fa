#include "bake/simplify.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>

#include "base/parallel.h"
#include "scene/mesh_vertices.h"

namespace roomlight::bake {
namespace {

constexpr size_t kFewTriangles = 64;
constexpr float kFurthestM = 20;       // from eyes, that counts
constexpr float kOfThickness = 0.01f;  // of its thickness a mesh may be off: planks, tiles and rugs lie on other things

float largestStretch(const Affine& a) { return std::max({length(a.x), length(a.y), length(a.z)}); }

// Of a mesh, over all its instances.
struct Placed {
  float stretch = 0;  // the largest
  float thicknessM = kInfinity;  // the smallest extent
  float coarser = kInfinity;  // the least
};

std::vector<Placed> placedMeshes(const Scene& scene, std::span<const float> coarser) {
  std::vector<Placed> out(scene.meshes.size());
  for (size_t k = 0; k < scene.instances.size(); ++k) {
    const Instance& i = scene.instances[k];
    const Vec3 size = instanceBounds(scene, i).size();
    Placed& p = out[static_cast<size_t>(i.mesh)];
    p.stretch = std::max(p.stretch, largestStretch(i.worldFromObject));
    p.thicknessM = std::min({p.thicknessM, size.x, size.y, size.z});
    p.coarser = std::min(p.coarser, coarser.empty() ? 1 : coarser[k]);
  }
  return out;
}

constexpr float kCreaseCos = 0.5f;  // faces that meet at more than 60° have normals of their own
constexpr float kPlaneCos = 0.996f;  // up to 5°: of a plane, and of what is too small beside it to count
constexpr float kKeptCos = 0.97f;  // normals up to 14° off stay as they are

std::vector<Vec3> facesOf(const Mesh& mesh) {  // normals as long as twice the area
  std::vector<Vec3> out;
  for (size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    const Vec3 a = mesh.positions[mesh.indices[i]];
    out.push_back(cross(mesh.positions[mesh.indices[i + 1]] - a, mesh.positions[mesh.indices[i + 2]] - a));
  }
  return out;
}

using Corners = std::array<uint32_t, 3>;

std::vector<Corners> cornersOf(const std::vector<uint32_t>& indices) {  // of each triangle, rising
  std::vector<Corners> out;
  for (size_t i = 0; i + 2 < indices.size(); i += 3) {
    out.push_back({indices[i], indices[i + 1], indices[i + 2]});
    std::sort(out.back().begin(), out.back().end());
  }
  return out;
}

uint32_t withNormal(Mesh& mesh, uint32_t vertex, Vec3 normal) {
  const uint32_t added = repeatVertex(mesh, vertex);
  mesh.normals[added] = normal;
  return added;
}

// The smooth normals of a ceiling's edge lean outwards, and vertices beside it stand upright. Without those the whole
// ceiling would lean: corners of planes take the mean normal of the faces around them, by area. What is round keeps its
// own, which are better than those of coarse faces.
// Triangles that are as they were, by `before`, stay so.
void mendNormals(Mesh& mesh, const std::vector<Corners>& before) {
  const std::vector<Vec3> faces = facesOf(mesh);
  std::vector<std::vector<uint32_t>> around(mesh.positions.size());
  for (size_t i = 0; i < mesh.indices.size(); ++i) around[mesh.indices[i]].push_back(static_cast<uint32_t>(i / 3));
  const std::vector<Corners> after = cornersOf(mesh.indices);
  std::map<std::tuple<uint32_t, float, float, float>, uint32_t> made;
  for (size_t i = 0; i < mesh.indices.size(); ++i) {
    const uint32_t vertex = mesh.indices[i];
    const Vec3 own = faces[i / 3];
    if (!(length(own) > 0) || std::binary_search(before.begin(), before.end(), after[i / 3])) continue;
    Vec3 sum;
    for (const uint32_t f : around[vertex]) {
      if (dot(faces[f], own) >= kCreaseCos * length(faces[f]) * length(own)) sum += faces[f];
    }
    const Vec3 mean = normalize(sum), given = mesh.normals[vertex];
    if (dot(mean, own) < kPlaneCos * length(own)) continue;
    // Some files have all normals the other way.
    if (std::abs(dot(mean, given)) >= kKeptCos * length(given)) continue;
    const Vec3 normal = dot(mean, given) < 0 ? -mean : mean;
    const auto [at, isNew] = made.try_emplace({vertex, normal.x, normal.y, normal.z}, 0);
    if (isNew) at->second = withNormal(mesh, vertex, normal);
    mesh.indices[i] = at->second;
  }
}

}  // namespace

std::vector<float> coarserFar(const Scene& scene, std::span<const Vec3> eyes) {
  std::vector<float> out;
  for (const Instance& i : scene.instances) {
    const Bounds3 bounds = instanceBounds(scene, i);
    float m = eyes.empty() ? 1 : kFurthestM;
    for (const Vec3 eye : eyes) m = std::min(m, length(max(min(eye, bounds.hi), bounds.lo) - eye));
    out.push_back(std::max(m, 1.0f));
  }
  return out;
}

std::vector<float> simplifyMeshes(Scene& scene, float errorM, std::span<const float> coarser) {
  const std::vector<Placed> placed = placedMeshes(scene, coarser);
  std::vector<float> moved(scene.meshes.size(), 0);
  parallelFor(scene.meshes.size(), 1, [&](size_t i) {
    Mesh& mesh = scene.meshes[i];
    if (mesh.triangleCount() < kFewTriangles || !(placed[i].stretch > 0)) return;
    const float* positions = &mesh.positions.front().x;
    const float scale = meshopt_simplifyScale(positions, mesh.positions.size(), sizeof(Vec3));
    if (!(scale > 0)) return;
    const float most = std::min(errorM * placed[i].coarser, kOfThickness * placed[i].thicknessM);
    std::vector<uint32_t> indices(mesh.indices.size());
    const size_t count =
        meshopt_simplify(indices.data(), mesh.indices.data(), mesh.indices.size(), positions, mesh.positions.size(),
                         sizeof(Vec3), 0, most / (placed[i].stretch * scale), 0, nullptr);
    if (count == 0 || count == indices.size()) return;  // a thing as small as the error stays as it is
    indices.resize(count);
    std::vector<Corners> before = cornersOf(mesh.indices);
    std::sort(before.begin(), before.end());
    mesh.indices = std::move(indices), moved[i] = most;
    if (!mesh.normals.empty()) mendNormals(mesh, before);
  });
  return moved;
}

}  // namespace roomlight::bake
