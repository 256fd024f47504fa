// Directions from a luminaire in proportion to the light it sends there: cells of its web are chosen by their flux, and
// a direction inside the cell evenly over its solid angle.
#pragma once

#include <vector>

#include "base/vec.h"
#include "photometry/photometric_web.h"

namespace roomlight {

class WebSampler {
 public:
  explicit WebSampler(const PhotometricWeb& web);  // must outlive the sampler

  // Unit, in the web's own axes; `pdf` per steradian.
  Vec3 sample(Vec2 u, float& pdf) const;
  float pdf(Vec3 direction) const;  // 0 where no light goes

 private:
  float density(size_t plane, size_t gamma) const { return density_[gamma * planes_ + plane]; }

  const PhotometricWeb& web_;
  size_t planes_;  // intervals of C
  std::vector<float> rowUpTo_;  // upper end of each interval of gamma, of all flux
  std::vector<float> upTo_;  // upper end of each cell in its row, of the row's flux
  std::vector<float> density_;  // per steradian, in each cell
};

}  // namespace roomlight
