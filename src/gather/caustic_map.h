// Illuminance by caustic photons: each is spread over a disc as large as photons around it are sparse (variable
// kernels, Silverman 1986, 5.3), so that all flux stays, borders are sharp where photons are dense, and nothing steps.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/simd.h"
#include "trace/caustic_photons.h"

namespace roomlight {

class CausticMap {
 public:
  CausticMap() = default;
  // The same for any number of threads. `layers`, where given: that light is told apart by.
  explicit CausticMap(std::span<const CausticPhoton> photons, const LightLayers* layers = nullptr);

  bool empty() const { return x_.empty(); }
  size_t bytes() const;
  struct Light {
    Vec3 lux;
    Vec3 from;         // where most of it comes from, unit
    float evenM2 = 0;  // as far, squared, it hardly changes on this surface; 0: that is not known
  };
  // On a surface at p whose geometric normal, unit, is n. Adds the lux of each layer to `byLayer`, unless that is
  // empty.
  Light at(Vec3 p, Vec3 n, std::span<Vec3> byLayer = {}) const;

 private:
  static constexpr int kLevels = 7;  // of cells, each twice as large as the one before
  static constexpr size_t kLanes = 8;
  struct Run {
    uint64_t key = 0;
    uint32_t begin = 0, end = 0;  // end 0: none
  };
  // Runs of equal keys, by key.
  class Runs {
   public:
    Runs() = default;
    Runs(std::span<const uint64_t> keys, std::span<const uint32_t> order);
    const Run* find(uint64_t key) const;
    size_t bytes() const { return table_.size() * sizeof(Run); }

   private:
    std::vector<Run> table_;  // open addressing, a power of two
  };
  static uint64_t keyOf(Vec3 cell, int level);
  template <class Visit>
  static void visitCells(Vec3 p, int level, const Runs& runs, const Visit& visit);
  static std::vector<float> radii(std::span<const CausticPhoton> photons);
  static std::vector<float> radiiByLayer(std::span<const CausticPhoton> photons, const LightLayers& layers);
  void addToLayers(Float8 weight, size_t i, std::span<Vec3> byLayer) const;
  void markLevels(std::span<const CausticPhoton> photons, std::span<const float> radius);

  // Of each photon, those of a cell one after the other; with some more at the end, for loads of eight.
  std::vector<float> x_, y_, z_, nx_, ny_, nz_, perRadius2_;
  std::array<std::vector<float>, 3> lux_;  // in the middle of its disc,
  std::array<std::vector<float>, 3> from_;  // and the direction it comes from, times its luminance
  std::vector<int8_t> layer_;  // -1: of none; empty: light is not told apart
  Runs cells_;
  Runs levels_;  // of the largest cells: `begin` has a bit for every level whose discs reach into it
};

}  // namespace roomlight
