// Turns the triangles that touch one brick into its voxel records.
#pragma once

#include <span>
#include <vector>

#include "scene/scene.h"
#include "voxel/lattice.h"
#include "voxel/voxelise.h"

namespace roomlight {

// Triangle in voxel coordinates; `front` is its unit front normal in world space.
struct LatticeTriangle {
  Vec3 a, b, c, front;
  float area = 0;  // in voxels²
};
LatticeTriangle latticeTriangle(const Scene& scene, const Lattice& lattice, uint32_t instance, uint32_t triangle);

struct BrickRecords {
  std::array<uint64_t, 8> occupied{};
  std::vector<SurfaceVoxel> voxels;  // firstSlot relative to this brick
  std::vector<FaceSlot> slots;
};

// `brick` in bricks from the world's origin, like `references` of the triangles that reach into it.
BrickRecords buildBrick(const Scene& scene, const Lattice& lattice, Int3 brick,
                        std::span<const Voxelisation::Reference> references);

}  // namespace roomlight
