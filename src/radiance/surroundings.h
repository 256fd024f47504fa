// Where the light of a small source comes by particles rather than by shadow rays.
#pragma once

#include <vector>

#include "trace/lights.h"

namespace roomlight {

class LightSurroundings {
 public:
  LightSurroundings() = default;  // contain nothing
  LightSurroundings(const Lamp& lamp, float voxelSizeM);
  // Of an emissive mesh within `box`.
  LightSurroundings(const Bounds3& box, float voxelSizeM);
  bool contains(Vec3 p) const;
  // Whether it may contain anything of the box.
  bool touches(const Bounds3& box) const;
  // Holds all of it.
  Bounds3 bounds() const;
  // How many times as large it is as that of a point.
  float sizeOfPoints() const;

 private:
  Vec3 toSource(Vec3 p) const;
  float reachM() const { return std::max(near_, far_) + length(half_); }

  Vec3 position_, direction_{0, 0, 1}, acrossC0_{1, 0, 0}, acrossC90_{0, 1, 0};  // unit
  Vec3 half_;  // m; of an extended lamp's opening or the box, along acrossC0_, acrossC90_ and direction_
  float near_ = 0, far_ = 0;  // m: in all directions, and along a narrow spot
  float tanOuter_ = 0, voxelSizeM_ = 0;
};

// Of each emissive mesh; those of large ones contain nothing: they are no brighter than what shadow rays and gathering
// rays can deal with, for illuminance stays below pi times their luminance.
std::vector<LightSurroundings> emitterSurroundings(const Lights& lights, float voxelSizeM);
bool isSmall(const Lights& lights, size_t emitter, float voxelSizeM);

}  // namespace roomlight
