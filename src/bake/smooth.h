// Noise taken from the light of an atlas, by neighbours on the same surface, whichever chart they are of.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "bake/layers.h"
#include "trace/ray_scene.h"

namespace roomlight::bake {

// Takes noise from the layers: a mean over neighbours whose light is the same up to what their errors explain, in two
// passes, the second with gaps (à-trous: Dammertz et al. 2010). Where a chart ends and another one goes on, its texels
// are neighbours too, and on the edge both get the mean of both, unless their light differs so much that something must
// part them. Neighbours without one on the opposite side count less: what falls off evenly nearly stays as it is at an
// edge. Does not depend on the number of threads.
class Smoothing {
 public:
  // The scene is the one that the atlas is of. `buried`: elements (LitPlaces).
  Smoothing(const Atlas& atlas, std::span<const uint8_t> buried, const RayScene& rays);
  void smooth(const Atlas& atlas, std::vector<BakedLayer>& layers) const;

  // Other elements by element, each with a number.
  template <class T>
  struct Others {
    std::vector<size_t> first{0};  // in `of`; one more than there are elements
    std::vector<std::pair<uint32_t, T>> of;
    void add(std::span<const std::pair<uint32_t, T>> next) {
      of.insert(of.end(), next.begin(), next.end());
      first.push_back(of.size());
    }
  };
  struct Pass {
    int step = 1;  // texels between neighbours
    Others<uint8_t> beyond;  // neighbours in other charts, and which of the square of neighbours they are, in rows
  };

 private:
  std::vector<Pass> passes_;
  Others<float> welds_;  // what other charts have at the same place, and weights, which add up to one
};

}  // namespace roomlight::bake
