// Light that leaves the places where gathering rays of one camera arrive, finer than voxels and without their errors: a
// hashed grid of cells, filled from the very hits that rays of this picture find, then only read (after the radiance
// caches of Boissé et al. 2023, "GI-1.0", and Binder et al. 2019, "Massively parallel path space filtering").
//
// A cell holds the mean of what its samples send out, as found and as told by their neighbours (smoothLight). What
// lies hidden within furniture is never hit, so it counts for nothing, and the mean over all rays is right however
// coarse the cells are. Places seldom hit share larger cells.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "trace/ray_scene.h"

namespace roomlight {

struct HitCell {
  Vec3 radianceCdM2;  // as of a Lambertian surface, its albedo included
  Vec3 ownCdM2;  // the same of a white surface, as its samples found it: for what panes show, where light told by what
                 // lies beside would be seen
  float lux = 0, ownLux = 0,
        sunLux = 0;  // luminous illuminance, as of either; that of the sun, where there is one alone
  Vec3 place, normal;  // a surface point that the cell stands for
  int64_t slot = -1;  // of the voxel there
  float sizeM = 0;
  uint32_t shares = 0;  // see HitCache::shares()
  bool sure = false;  // nothing else lies in its voxels: places in it need no ray to the cell's own
};

// Where a ray arrived.
struct HitPlace {
  Vec3 p, n;  // n: unit, on the side that is looked at
  uint32_t instance = 0;
};

// One sample of the light there.
struct LitHit {
  HitPlace at;
  Vec3 albedo;  // radiances below are as of a white surface
  Vec3 even, rare, sharp;  // SurfaceLight's diffuse, rare and sharp light; smoothLight() changes the first two
  Vec3 own;  // the three as they were found
  float sunLux = 0;
  float rays = 1;  // that it stands for
  uint32_t number = 0;  // of the sample, in HitLayers
  int64_t slot = -1;
  bool sure = false;
};

class HitLayers;

class HitCache {
 public:
  static constexpr int kLevels = 3;  // of cells, each twice as large as the one before
  static constexpr size_t kFewest = 4;  // samples that a cell is made of, but for the largest cells

  HitCache() = default;
  // `voxelM`: larger cells reach beyond the voxels that samples are sure of.
  HitCache(float cellM, float voxelM) : cellM_(cellM), voxelM_(voxelM) {}

  float cellM() const { return cellM_; }
  bool empty() const { return cells_.empty(); }
  // Which of the places shall be lit: of those that share a cell at most `most`, in their order; and how many places
  // each stands for.
  struct Chosen {
    uint32_t place;
    float rays;
  };
  std::vector<Chosen> chosen(std::span<const HitPlace> places, size_t most) const;
  // A sample that the cell's first sample cannot see is left out. The result does not depend on the number of threads.
  // `layers`, where given: whose the samples' light is.
  void fill(const RayScene& rays, std::span<const LitHit> samples, const HitLayers* layers = nullptr);
  // Of a cell's light, as SlotLayers::at(); only of cells filled with layers.
  const uint16_t* shares(const HitCell& cell) const { return shares_.data() + cell.shares; }
  // Null where no cell knows the place.
  const HitCell* find(const HitPlace& place) const;
  // Has what find() reads fetched into the processor's cache.
  void prefetch(std::span<const HitPlace> places) const;
  // Between a place and the one that a cell stands for, both a little before their surface: where nothing is in the
  // way, the cell's light is that of the place.
  static Ray between(const HitCell& cell, const HitPlace& place);
  // Of the cell of a level around it, whether or not it holds anything; not 0.
  uint64_t keyOf(const HitPlace& place, int level) const;

 private:
  struct Entry {
    uint64_t key = 0;  // 0: none
    uint32_t cell = 0;
  };
  void fillLevel(const RayScene& rays, std::span<const LitHit> samples, const HitLayers* layers, int level,
                 std::vector<uint8_t>& covered);
  void insert(uint64_t key, uint32_t cell);
  void makeTable(std::span<const uint64_t> keys);

  float cellM_ = 0.05f, voxelM_ = 0.1f;
  std::vector<HitCell> cells_;
  std::vector<uint64_t> keys_;
  std::vector<uint16_t> shares_;  // half floats, of cells one after the other
  std::vector<Entry> table_;  // open addressing, a power of two
};

// Light of places where gathering rays arrive, each lit by few rays, as far as their neighbours tell it better: nested
// grids of cells on one surface, the mean of each drawn towards that of the next larger one by how uncertain it is
// beside how much cells of its size differ (empirical Bayes, Efron & Morris 1975). What single rays found far beyond
// what all should is spread over the largest. Changes `even` and `rare` of all samples. Of what shares a largest cell
// only what has a free way to the same place is put together. The result does not depend on the number of threads.
void smoothLight(const RayScene& rays, const HitCache& cells, std::span<LitHit> samples);

}  // namespace roomlight
