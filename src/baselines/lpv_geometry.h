// What stands in the way of light in a propagation volume: the geometry volume.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "voxel/voxels.h"

namespace roomlight {

// Cubic cells in a box.
struct LpvLattice {
  Vec3 corner;  // world; of the first cell
  float cellM = 1;
  Int3 cells{1, 1, 1};

  Int3 padded() const { return {cells.x + 2, cells.y + 2, cells.z + 2}; }
  size_t paddedCount() const {
    return static_cast<size_t>(cells.x + 2) * static_cast<size_t>(cells.y + 2) * static_cast<size_t>(cells.z + 2);
  }
  // Cell in the lattice with one layer around it: its own are 1 .. cells.
  size_t index(Int3 c) const {
    return (static_cast<size_t>(c.z) * static_cast<size_t>(cells.y + 2) + static_cast<size_t>(c.y)) *
               static_cast<size_t>(cells.x + 2) +
           static_cast<size_t>(c.x);
  }
  Vec3 centre(Int3 c) const {
    return corner +
           Vec3{static_cast<float>(c.x) - 0.5f, static_cast<float>(c.y) - 0.5f, static_cast<float>(c.z) - 0.5f} * cellM;
  }
  // In cells from the corner.
  Vec3 local(Vec3 p) const { return (p - corner) * (1 / cellM); }
  Int3 cellOf(Vec3 p) const {
    const Vec3 q = local(p);
    return {static_cast<int>(std::floor(q.x)) + 1, static_cast<int>(std::floor(q.y)) + 1,
            static_cast<int>(std::floor(q.z)) + 1};
  }
  bool contains(Int3 c) const {
    return c.x >= 1 && c.y >= 1 && c.z >= 1 && c.x <= cells.x && c.y <= cells.y && c.z <= cells.z;
  }
  // Of the layer around its own.
  bool isBorder(Int3 c) const { return !contains(c); }
};

// Cells so small that `cells` are along the longest edge of the box and a free one at each end, but not below
// `smallestM`.
LpvLattice latticeAround(const Bounds3& box, int cells, float smallestM);

// A piece of one side of a surface.
struct Surfel {
  Vec3 p, n, albedo;
  float areaM2;  // of what is opaque
};

// Blocking potential at the corners of cells, half a cell off their middles: the share of light along w that surfels
// stop, as the first four harmonics of their clamped cosines. Surfels that look to different sides are kept apart, and
// the one that stops most counts: the two sides of a wall would else cancel each other.
class LpvGeometry {
 public:
  // Empty.
  explicit LpvGeometry(const LpvLattice& lattice) : lattice_(lattice) {}
  LpvGeometry(const LpvLattice& lattice, std::span<const Surfel> surfels);

  const LpvLattice& lattice() const { return lattice_; }
  bool empty() const { return corners_.empty(); }
  size_t bytes() const {
    return corners_.size() * sizeof(Corner) + passes_.size() * sizeof(float) + mirrors_.size() * sizeof(Mirror);
  }

  // Share of light that passes p along unit d, between corners.
  float passes(Vec3 p, Vec3 d) const;

  // Of what a padded cell sends out to the walls lpvWalls(): the shares that pass, wall by wall, one plane of cells
// each. Null where all is free.
  const float* passes(int wall) const {
    return passes_.empty() ? nullptr : &passes_[static_cast<size_t>(wall) * lattice_.paddedCount()];
  }
  // What stands in the way on one side of a cell, and sends back what it stops.
  struct Mirror {
    uint32_t cell;
    int side;
    Vec3 normal, albedo;
  };
  // In the order of cells, layer z from first to past the last.
  std::span<const Mirror> mirrors(int z) const;

 private:
  struct Corner {
    float area = 0;  // in cells' sides
    Vec3 normal;     // times area
    Vec3 albedo;     // times area
  };
  size_t cornerIndex(Int3 c) const {
    return (static_cast<size_t>(c.z) * static_cast<size_t>(lattice_.cells.y + 1) + static_cast<size_t>(c.y)) *
               static_cast<size_t>(lattice_.cells.x + 1) +
           static_cast<size_t>(c.x);
  }
  std::array<Corner, 6> between(Vec3 q) const;
  void meet(Int3 cell, int side, std::vector<Mirror>& mirrors);

  LpvLattice lattice_;
  std::vector<std::array<Corner, 6>> corners_;
  std::vector<float> passes_;
  std::vector<Mirror> mirrors_;
  std::vector<size_t> firstMirror_;  // per layer
};

}  // namespace roomlight
