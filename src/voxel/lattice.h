// Where the voxels lie. Coordinates "in voxels" count from the world's origin, whatever part of the world the bricks
// cover: a surface is cut the same way to the bit when the covered part grows or shrinks, and bricks untouched keep
// their records.
#pragma once

#include "scene/scene.h"
#include "voxel/voxels.h"

namespace roomlight {

struct Lattice {
  float voxelSizeM = 0;
  Int3 firstBrick;  // of the grid's lower corner, in bricks from the world's origin
  Int3 brickDims;

  Vec3 toVoxels(Vec3 world) const { return world / voxelSizeM; }
  Vec3 toWorld(Vec3 voxels) const { return voxels * voxelSizeM; }
  Vec3 originM() const;  // world position of the grid's lower corner

  // Coordinates in bricks from the world's origin of a brick given from the grid's corner.
  Int3 brickOf(Int3 fromCorner) const {
    return {firstBrick.x + fromCorner.x, firstBrick.y + fromCorner.y, firstBrick.z + fromCorner.z};
  }
  // Place of a brick in the dense index, from its coordinates in bricks from the world's origin, and back.
  uint32_t place(Int3 brick) const;
  Int3 brick(uint32_t place) const;
  bool contains(Int3 brick) const;
  size_t places() const {
    return static_cast<size_t>(brickDims.x) * static_cast<size_t>(brickDims.y) * static_cast<size_t>(brickDims.z);
  }
};

// Whole bricks around `bounds` with one voxel of margin; no bricks where the bounds are empty.
Lattice fitLattice(const Bounds3& bounds, float voxelSizeM);

Lattice latticeOf(const Voxels& voxels);

// The smallest size from `wantedM` upwards, in steps of a tenth, with which the dense index stays below 64 MiB and
// floats can still place a surface within its voxel. Returns `wantedM` for every home; larger only for absurd sizes.
float feasibleVoxelSizeM(const Bounds3& bounds, float wantedM);

}  // namespace roomlight
