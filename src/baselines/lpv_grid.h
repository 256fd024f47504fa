// Light propagation volumes: light in a grid of cells, each with what leaves it as an intensity in four spherical
// harmonics a colour, passed on from cell to cell (Kaplanyan & Dachsbacher 2010, "Cascaded Light Propagation Volumes
// for Real-Time Indirect Illumination"). docs/methods/lpv.md
#pragma once

#include <array>
#include <vector>

#include "baselines/lpv_geometry.h"

namespace roomlight {

// Intensity, cd, of one cell: per channel the coefficients of 1, x, y, z.
using LpvIntensity = std::array<std::array<float, 4>, 3>;

// The harmonics themselves, and those coefficients of max(cos, 0) about a direction.
constexpr float kSh0 = 0.28209479f, kSh1 = 0.48860251f;
constexpr float kCosine0 = 0.88622693f, kCosine1 = 1.02332671f;

// Structure of arrays: coefficient by coefficient of channel by channel, cell after cell. One layer of cells around
// those of the lattice belongs to it: nothing is passed on to them, but what they hold is passed on.
class LpvGrid {
 public:
  explicit LpvGrid(const LpvLattice& lattice) : lattice_(lattice), values_(12 * lattice.paddedCount()) {}

  const LpvLattice& lattice() const { return lattice_; }
  float* plane(int channel, int coefficient) {
    return &values_[static_cast<size_t>(4 * channel + coefficient) * lattice_.paddedCount()];
  }
  const float* plane(int channel, int coefficient) const {
    return &values_[static_cast<size_t>(4 * channel + coefficient) * lattice_.paddedCount()];
  }
  size_t bytes() const { return values_.size() * sizeof(float); }

  // A Lambertian reflection of `fluxLm` about unit n, into a cell (counted with the layer around).
  void addLobe(size_t cell, Vec3 n, Vec3 fluxLm);
  void set(size_t cell, const LpvIntensity& intensity);
  LpvIntensity get(size_t cell) const;
  void add(const LpvGrid& other);
  // In the lattice's own cells, lm.
  Vec3 fluxLm() const;

 private:
  LpvLattice lattice_;
  std::vector<float> values_;
};

// What a cell passes on: through its side `side` (in the order of faceDirection()) to the wall `wall` of the cell
// behind. `weight` integrates the harmonics over the solid angle of that wall, seen from the cell's middle.
struct LpvWall {
  int side, wall;
  std::array<float, 4> weight;
  float solidAngleSr;
  Vec3 direction;  // unit, the mean
};
constexpr int kLpvWalls = 30;
// Together they are the whole sphere.
const std::array<LpvWall, kLpvWalls>& lpvWalls();

// The sum of `light` and all that `steps` steps make of it. `reflect`: what geometry stops goes on from it, less what
// it absorbs; else all of it ends there.
LpvGrid propagate(const LpvGrid& light, const LpvGeometry& geometry, int steps, bool reflect);

}  // namespace roomlight
