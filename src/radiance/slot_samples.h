// Shadow rays of slots, traced together.
#pragma once

#include <utility>
#include <vector>

#include "trace/ray_scene.h"

namespace roomlight {

// Light that slots get by shadow rays: gathered for a brick, traced together.
class SlotSamples {
 public:
  // `lux`: what the slot gets if nothing is in the ray's way.
  void ask(size_t slot, const Ray& ray, Vec3 lux) { rays_.push_back(ray), light_.emplace_back(slot, lux); }
  // Adds what arrives to each slot's lux. Returns how many rays that took.
  size_t addTo(const RayScene& scene, std::vector<Vec3>& lux) const {
    std::vector<Vec3> left(rays_.size());
    scene.transmittance(rays_, left);
    for (size_t i = 0; i < left.size(); ++i) lux[light_[i].first] += light_[i].second * left[i];
    return rays_.size();
  }

 private:
  std::vector<Ray> rays_;
  std::vector<std::pair<size_t, Vec3>> light_;
};

}  // namespace roomlight
