// Whose the light of places is where gathering rays arrive, for cells of light in layers. The soft light of each layer
 // is told by neighbours, as that of all together is.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "gather/hit_cache.h"
#include "gather/layer_light.h"

namespace roomlight {

class HitLayers {
 public:
  HitLayers(size_t layers, size_t samples)
      : layers_(layers), stride_(layerStride(layers)), samples_(samples), light_(2 * layers * samples) {}
  // Light of sample `number`, thing `thing` of the sums. May be called by many threads, for different samples.
  void take(uint32_t number, const LayerSums& sums, size_t thing);
  // Smoothes each layer's light of the samples (hit_smoothing.h), which are as they were found. Those of one layer
// count as many rays as the samples do.
  void smooth(const RayScene& rays, const HitCache& cells, std::span<const LitHit> samples);
  // Appends the shares of what these samples send out together, half floats: three channels, each a stride of layers.
  void addShares(std::span<const LitHit> samples, std::span<const uint32_t> members, std::vector<uint16_t>& out) const;

 private:
  Vec3& soft(size_t layer, size_t number) { return light_[layer * samples_ + number]; }
  Vec3& sharp(size_t layer, size_t number) { return light_[(layers_ + layer) * samples_ + number]; }
  Vec3 all(size_t layer, size_t number) const {
    return light_[layer * samples_ + number] + light_[(layers_ + layer) * samples_ + number];
  }

  size_t layers_, stride_, samples_;
  std::vector<Vec3> light_;  // soft of each layer, then sharp
};

}  // namespace roomlight
