// The scene as sparse voxels: geometry and materials, no light. Flat arrays of plain structs, ready to upload.
//
//   brickIndex[bz][by][bx]  dense, -1 or an index into `bricks`
//   Brick                   8^3 voxels: which are occupied (512 bits), where its voxel records start
//   SurfaceVoxel            sub-voxel mask, projected coverage per axis, where its slots start
//   FaceSlot                one facing side of the surfaces in a voxel: what receives and reflects light
//
// A surface with unit normal n belongs, with its front, to the slot of the axis direction nearest to n, and with its
// back to the opposite slot: thin walls keep their two sides apart inside one voxel.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <vector>

#include "base/vec.h"

namespace roomlight {

constexpr int kBrickSize = 8;  // voxels along an edge of a brick
constexpr int kBrickVoxels = kBrickSize * kBrickSize * kBrickSize;

struct Int3 {
  int x = 0, y = 0, z = 0;
  bool operator==(const Int3&) const = default;
};

// Axis directions in the order +x, -x, +y, -y, +z, -z; the index is "face".
inline Vec3 faceDirection(int face) {
  const float s = (face & 1) ? -1.0f : 1.0f;
  return {(face >> 1) == 0 ? s : 0.0f, (face >> 1) == 1 ? s : 0.0f, (face >> 1) == 2 ? s : 0.0f};
}
inline int dominantFace(Vec3 n) {
  const Vec3 a = abs(n);
  if (a.x >= a.y && a.x >= a.z) return n.x < 0 ? 1 : 0;
  if (a.y >= a.z) return n.y < 0 ? 3 : 2;
  return n.z < 0 ? 5 : 4;
}

struct FaceSlot {
  Vec3 position;   // world; centre of the foremost large piece of surface on this side, so it lies on a surface
  Vec3 normal;     // unit, mean of their normals, pointing to this side
  Vec3 albedo;     // bihemispherical, area-weighted mean, 0..1
  Vec3 emission;  // luminance in cd/m² to this side, area-weighted mean: emission * areaM2 * pi is the exact flux in lm
  float areaM2 = 0;  // true (not projected) area of the opaque part of the surfaces on this side
  float opacity = 1;  // 0..1, opaque share of those surfaces: below 1 for panes, veils and leaves cut out by a mask
  uint32_t instance = 0;  // the instance with the largest area here
  uint8_t face = 0;
};

struct SurfaceVoxel {
  uint64_t mask = 0;  // 4x4x4 sub-cells touched; bit x + 4 y + 16 z
  Vec3 opacity;  // 0..1, fraction of the voxel's cross-section that is covered, seen along x, y, z
  uint32_t firstSlot = 0;
  uint8_t faces = 0;  // bit f: a slot for face f exists; slots follow in order of f
};

struct Brick {
  Int3 coord;  // in bricks, from the grid's origin
  uint32_t firstVoxel = 0;
  std::array<uint64_t, 8> occupied{};  // word z, bit x + 8 y
  std::array<uint16_t, 8> before{};  // records of this brick in words before this one
};

// Where there are voxels.
struct BrickGrid {
  float voxelSizeM = 0;
  Vec3 origin;  // world position of the lower corner of brick (0,0,0); a multiple of the brick's edge
  Int3 brickDims;
  std::vector<int32_t> brickIndex;  // x fastest
  std::vector<Brick> bricks;  // in order of their position in brickIndex

  int32_t brickAt(Int3 b) const {
    if (b.x < 0 || b.y < 0 || b.z < 0 || b.x >= brickDims.x || b.y >= brickDims.y || b.z >= brickDims.z) return -1;
    return brickIndex[(static_cast<size_t>(b.z) * brickDims.y + b.y) * brickDims.x + b.x];
  }
  // Record of the voxel with integer coordinates v, or -1 where there is no surface.
  int64_t voxelAt(Int3 v) const {
    if (v.x < 0 || v.y < 0 || v.z < 0) return -1;
    const int32_t b = brickAt({v.x / kBrickSize, v.y / kBrickSize, v.z / kBrickSize});
    if (b < 0) return -1;
    const Brick& brick = bricks[static_cast<size_t>(b)];
    const int word = v.z % kBrickSize, bit = v.x % kBrickSize + kBrickSize * (v.y % kBrickSize);
    if (!((brick.occupied[word] >> bit) & 1)) return -1;
    const uint64_t below = brick.occupied[word] & ((uint64_t{1} << bit) - 1);
    return brick.firstVoxel + brick.before[word] + std::popcount(below);
  }
  Int3 voxelOf(Vec3 p) const {
    const Vec3 q = (p - origin) / voxelSizeM;
    return {static_cast<int>(std::floor(q.x)), static_cast<int>(std::floor(q.y)), static_cast<int>(std::floor(q.z))};
  }
};

// Index of the slot of a face of a voxel, or -1. The voxel has `faces` and `firstSlot` as SurfaceVoxel does.
template <class Voxel>
int64_t slotOf(const Voxel& voxel, int face) {
  if (!((voxel.faces >> face) & 1)) return -1;
  return voxel.firstSlot + std::popcount(static_cast<unsigned>(voxel.faces & ((1u << face) - 1)));
}

struct Voxels : BrickGrid {
  std::vector<SurfaceVoxel> voxels;  // grouped by brick, x fastest
  std::vector<FaceSlot> slots;  // grouped by voxel

  size_t bytes() const;
  int64_t slotAt(const SurfaceVoxel& voxel, int face) const { return slotOf(voxel, face); }
};

}  // namespace roomlight
