// Whose the light of places is where gathering rays arrive, for cells of light in layers. Single samples tell little of it, so what is not straight from suns and lamps is shared among layers as by all
// samples around.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "gather/hit_cache.h"
#include "gather/layer_light.h"

namespace roomlight {

class HitLayers {
 public:
  HitLayers(size_t layers, size_t samples) : layers_(layers), stride_(layerStride(layers)), sharp_(samples * size()), soft_(samples * size()) {}
  // Light of sample `number`, thing `thing` of the sums. May be called by many threads, for different samples.
  void take(uint32_t number, const LayerSums& sums, size_t thing);
  // Of all samples, before their light is smoothed. Those of one cell, four times as large as the smallest, count as many rays as they stand for.
  void share(const HitCache& cells, std::span<const LitHit> samples);
  // Appends the shares of what these samples send out together: three channels, each a stride of layers.
  void addShares(std::span<const LitHit> samples, std::span<const uint32_t> members, std::vector<uint16_t>& out) const;

 private:
  size_t size() const { return 3 * stride_; }

  size_t layers_, stride_;
  std::vector<uint16_t> sharp_, soft_;  // half floats: per sample the shares of its light, three channels each
};

}  // namespace roomlight
