// Light on slots as a value of its own, for pictures that are made while voxels and cache follow a change: what a
// surface receives anywhere, interpolated between slots.
#pragma once

#include <span>
#include <vector>

#include "voxel/voxels.h"

namespace roomlight {

// What falls on one side of a surface, lx per channel.
struct SlotIrradiance {
  Vec3 soft;   // from all around, and
  Vec3 sharp;  // straight from suns, small lamps and what was edited last, as voxels know it: shadows as coarse as they
               // are
  bool found = false;  // else no slot is near
  bool sure = false;  // p lies on sheets that their voxels hold alone: nothing else can be meant
};

class SlotSnapshot {
 public:
  // One value a slot: all light, and the part of it that comes straight from suns, small lamps and the emissive meshes
  // that instances `emissive` are.
  SlotSnapshot(const Voxels& voxels, std::span<const Vec3> irradianceLux, std::span<const Vec3> sharpLux,
               std::vector<uint32_t> emissive = {});

  // Mean of the eight voxels around p, weighted by nearness, of slots that face as n (unit) does and whose plane p lies
  // on; where there is none, the nearest's.
  SlotIrradiance at(Vec3 p, Vec3 n) const;
  const std::vector<uint32_t>& sharpEmissive() const { return emissive_; }
  float voxelSizeM() const { return 1 / perMetre_; }

 private:
  struct Record {
    uint32_t soft = 0, sharp = 0;  // three channels of one exponent
    int8_t normalX = 0, normalY = 0, normalZ = 0;  // in 1/127
    bool alone = false;  // one sheet, and nothing else in its voxel
    float offset = 0;  // of its plane along the normal, in voxels from the lattice's origin
    Vec3 normal() const {
      return Vec3{static_cast<float>(normalX), static_cast<float>(normalY), static_cast<float>(normalZ)} * (1.0f / 127);
    }
  };
  struct Cell {
    uint32_t firstSlot;
    uint8_t faces;  // as SurfaceVoxel's
  };
  void smooth(const Voxels& voxels, std::vector<Vec3>& soft) const;
  void findBeside(Int3 v, const Record& r, int face, std::array<int32_t, 8>& beside) const;
  const Cell* cellAt(Int3 v) const {
    const int64_t i = grid_.voxelAt(v);
    return i < 0 ? nullptr : &cells_[static_cast<size_t>(i)];
  }
  const Record* recordOf(const Cell& cell, int face) const {
    const int64_t i = slotOf(cell, face);
    return i < 0 ? nullptr : &records_[static_cast<size_t>(i)];
  }

  float perMetre_;  // voxels
  std::vector<uint32_t> emissive_;
  BrickGrid grid_;
  std::vector<Cell> cells_;
  std::vector<Record> records_;
};

}  // namespace roomlight
