// Whose the light on slots is: the shares of lamps, suns and sky, for light that is kept in layers.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "trace/light_layers.h"

namespace roomlight {

struct SlotLayers {
  std::shared_ptr<const LightLayers> lights;  // none: light is not kept apart
  size_t stride = 0;                          // layers, rounded up to four
  std::vector<uint16_t> shares;  // per slot: of irradiance, three channels of `stride` half floats; the sum of a
 // channel is 1, or 0 where that is dark
  std::vector<uint64_t> reach;   // per brick: bit l where layer l was found to shine straight on a slot
  std::vector<int8_t> glowOf;  // per slot: the layer that glow there is reflected light of; empty: there is no glow

  bool empty() const { return !lights; }
  size_t slotSize() const { return 3 * stride; }
  const uint16_t* at(size_t slot) const { return shares.data() + slot * slotSize(); }
  size_t bytes() const { return shares.size() * sizeof(uint16_t) + reach.size() * sizeof(uint64_t) + glowOf.size(); }
};

inline size_t layerStride(size_t layers) { return (layers + 3) / 4 * 4; }

}  // namespace roomlight
