// What several voxel tests ask of a voxelisation.
#pragma once

#include <cstring>
#include <random>

#include "support/rooms.h"
#include "voxel/voxelise.h"

namespace roomlight::test {

inline VoxelSettings withSize(float voxelSizeM) {
  VoxelSettings settings;
  settings.voxelSizeM = voxelSizeM;
  return settings;
}

inline bool sameBits(Vec3 a, Vec3 b) { return std::memcmp(&a, &b, sizeof(Vec3)) == 0; }

inline bool sameBits(const FaceSlot& a, const FaceSlot& b) {
  return sameBits(a.position, b.position) && sameBits(a.normal, b.normal) && sameBits(a.albedo, b.albedo) &&
         sameBits(a.emission, b.emission) && std::memcmp(&a.areaM2, &b.areaM2, sizeof(float)) == 0 &&
         a.opacity == b.opacity && a.instance == b.instance && a.face == b.face;
}

inline bool sameBits(const SurfaceVoxel& a, const SurfaceVoxel& b) {
  return a.mask == b.mask && sameBits(a.opacity, b.opacity) && a.firstSlot == b.firstSlot && a.faces == b.faces;
}

inline bool sameBits(const Brick& a, const Brick& b) {
  return a.coord == b.coord && a.firstVoxel == b.firstVoxel && a.occupied == b.occupied && a.before == b.before;
}

template <class T>
bool sameBits(const std::vector<T>& a, const std::vector<T>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const T& x, const T& y) { return sameBits(x, y); });
}

// The first array in which the two differ; empty where they are the same, bit for bit.
inline std::string difference(const Voxelisation& a, const Voxelisation& b) {
  if (a.voxels.voxelSizeM != b.voxels.voxelSizeM) return "voxelSizeM";
  if (!sameBits(a.voxels.origin, b.voxels.origin)) return "origin";
  if (!(a.voxels.brickDims == b.voxels.brickDims)) return "brickDims";
  if (a.voxels.brickIndex != b.voxels.brickIndex) return "brickIndex";
  if (!sameBits(a.voxels.bricks, b.voxels.bricks)) return "bricks";
  if (!sameBits(a.voxels.voxels, b.voxels.voxels)) return "voxels";
  if (!sameBits(a.voxels.slots, b.voxels.slots)) return "slots";
  if (a.firstReference != b.firstReference) return "firstReference";
  if (a.references != b.references) return "references";
  return {};
}

inline Affine turned(float angleRad, Vec3 axis, Vec3 to) {
  const Frame f(normalize(axis));
  const float c = std::cos(angleRad), s = std::sin(angleRad);
  const auto turn = [&](Vec3 v) {
    const Vec3 l = f.toLocal(v);
    return f.toWorld({c * l.x - s * l.y, s * l.x + c * l.y, l.z});
  };
  return {turn({1, 0, 0}), turn({0, 1, 0}), turn({0, 0, 1}), to};
}

// Triangles of all sizes and directions in a cube of `edgeM`, as one instance.
inline Scene triangleSoup(int count, float edgeM, uint32_t seed) {
  Scene scene;
  Mesh mesh;
  mesh.material = addMaterial(scene, lambertian(0.5f));
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> unit(-1, 1);
  const auto vector = [&](float scale) { return Vec3{unit(random), unit(random), unit(random)} * scale; };
  for (int t = 0; t < count; ++t) {
    const Vec3 centre = vector(edgeM / 2);
    const float size = edgeM / 4 * std::pow(10.0f, -1.5f - 1.5f * unit(random));
    for (int k = 0; k < 3; ++k) {
      mesh.indices.push_back(static_cast<uint32_t>(mesh.positions.size()));
      mesh.positions.push_back(centre + vector(size));
    }
  }
  scene.meshes.push_back(mesh);
  scene.instances.push_back({"soup", 0, 0, {}});
  return scene;
}

inline double meshAreaM2(const Scene& scene) {
  double area = 0;
  for (const Instance& instance : scene.instances) {
    const Mesh& mesh = scene.meshes[static_cast<size_t>(instance.mesh)];
    for (size_t t = 0; t + 2 < mesh.indices.size(); t += 3) {
      const auto corner = [&](size_t k) { return instance.worldFromObject.point(mesh.positions[mesh.indices[t + k]]); };
      area += 0.5 * static_cast<double>(length(cross(corner(1) - corner(0), corner(2) - corner(0))));
    }
  }
  return area;
}

}  // namespace roomlight::test
