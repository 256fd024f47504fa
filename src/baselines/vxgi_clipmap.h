// Voxel cone tracing's store of light: nested cubes of voxels about one place, each level twice as large as the one
// before and of as many voxels (Panteleev 2014, "Practical Real-Time Voxel-Based Global Illumination for Current
// GPUs"). A voxel shows each of the six axis directions an opacity and a radiance. docs/methods/vxgi.md
#pragma once

#include <cstdint>
#include <vector>

#include "base/simd.h"
#include "voxel/voxels.h"

namespace roomlight {

class VxgiClipmap {
 public:
  // Level 0 has voxels of `voxelSizeM` and lies about `centre`, as close as the voxels of the coarser levels allow:
  // theirs are made of whole ones. All is empty.
  VxgiClipmap(Vec3 centre, float voxelSizeM, int resolution, int levels);

  int resolution() const { return n_; }
  int levels() const { return static_cast<int>(levels_.size()); }
  float voxelSizeM(int level) const { return levels_[static_cast<size_t>(level)].voxelSizeM; }
  // Of a level's lower corner, in its voxels from the world's origin: even.
  Int3 corner(int level) const { return levels_[static_cast<size_t>(level)].corner; }
  size_t bytes() const { return texels_.size() * sizeof(uint16_t); }

  // Whether the voxel, counted from the level's corner, is made of those of the next finer level.
  bool isMadeOfFiner(int level, Int3 v) const;
  bool contains(Int3 v) const;  // counted from any level's corner

  // What a voxel shows to direction `face`: radiance (of what is opaque; cd/m²) and opacity 0..1.
  void set(int level, Int3 v, int face, Vec3 radiance, float opacity);
  // The same, radiance times opacity and opacity.
  Float4 get(int level, Int3 v, int face) const;
  // Fills what is made of finer voxels, from the finest level on: front over back along each direction, the mean of the
  // four columns.
  void buildCoarser();
  void clear();  // all is empty again
  // Notes where there is nothing, which later changes of light must leave so: sampling there is quicker.
  void findEmpty();

  // Radiances are kept as half floats, in this unit.
  void setUnit(float cdM2) { unit_ = cdM2; }
  float unit() const { return unit_; }

  // The finest level that can be interpolated at p (world); levels() where none can.
  int levelAt(Vec3 p) const { return levelAt(p, 0); }
  // The same, known to be no finer than one below `near`, as for a place close by.
  int levelAt(Vec3 p, int near) const;
  // Radiance times opacity in x, y, z, and opacity in w, as seen by who looks along unit d: between the eight voxels
  // around p, and of the three directions that face the looker by their cosines, which makes the opacity that of the
  // area seen, at most 1. In unit(). p must lie in the level.
  Float4 sample(int level, Vec3 p, Vec3 d) const;

 private:
  struct Level {
    float voxelSizeM = 0;
    Int3 corner;
    Vec3 firstCentre;  // world: middle of the voxel at the corner
    size_t first = 0;  // in texels_
    float perM = 0;  // voxels
  };
  bool reaches(const Level& level, Vec3 p) const {
    const Vec3 q = (p - level.firstCentre) * level.perM;
    return minComponent(q) >= 0 && maxComponent(q) < static_cast<float>(n_ - 1);
  }
  size_t place(size_t level, Int3 v) const {
    const auto n = static_cast<size_t>(n_);
    return ((level * n + static_cast<size_t>(v.z)) * n + static_cast<size_t>(v.y)) * n + static_cast<size_t>(v.x);
  }
  size_t texel(const Level& level, int face, Int3 v) const {
    const auto n = static_cast<size_t>(n_);
    return level.first +
           4 * (((static_cast<size_t>(face) * n + static_cast<size_t>(v.z)) * n + static_cast<size_t>(v.y)) * n +
                static_cast<size_t>(v.x));
  }
  void put(int level, Int3 v, int face, Float4 value);
  Float4 composed(int finer, Int3 v, int face) const;

  int n_;
  std::vector<Level> levels_;
  std::vector<uint16_t>
      texels_;  // half floats; level by level, face by face, x fastest: radiance times opacity, opacity
  std::vector<uint8_t> empty_;  // per voxel of each level: whether it and the seven beyond it, which are interpolated
                                // together, hold nothing
  float unit_ = 1;
};

}  // namespace roomlight
