// Light on slots as it is kept: bricks that it does not reach take no memory, the others hold half floats.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "base/vec.h"
#include "trace/light_layers.h"
#include "voxel/voxels.h"

namespace roomlight {

class SlotLight {
 public:
  SlotLight() = default;
  // One value a slot, not negative; channels as they come.
  SlotLight(const Voxels& voxels, std::span<const Vec3> perSlot);

  bool empty() const { return values_.empty(); }
  bool reaches(size_t brick) const { return !first_.empty() && first_[brick] != kNone; }
  // Adds scale times this to one value a slot.
  void addTo(const Voxels& voxels, Vec3 scale, std::span<Vec3> perSlot) const;
  void addBrick(const Voxels& voxels, size_t brick, Vec3 scale, std::span<Vec3> perSlot) const;
  void scale(Vec3 by) { unit_ *= by; }
  // Of another brick with the same slots: to the slots from `firstSlot` on.
  void copyBrick(size_t brick, size_t slots, std::span<Vec3> to) const;
  size_t bytes() const { return first_.size() * sizeof(uint32_t) + values_.size() * sizeof(values_[0]); }

 private:
  static constexpr uint32_t kNone = 0xffffffffu;
  std::vector<uint32_t> first_;                  // per brick: where its values begin
  std::vector<std::array<uint16_t, 3>> values_;  // in unit_
  Vec3 unit_{1, 1, 1};
};

// Whose the light on slots is: the shares of lamps, suns and sky, for light that is kept in layers.
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
