// The first bounce where links would find it by chance only: off what the sun lights, and off surfaces that no slot
// stands for.
#pragma once

#include <utility>
#include <vector>

#include "radiance/bright_patches.h"
#include "radiance/links.h"
#include "radiance/slot_paths.h"
#include "trace/light_layers.h"
#include "trace/ray_scene.h"
#include "trace/traced_scene.h"

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

// Places that the scene's only sun lights, with the flux they reflect, Lambertian. `sunLux`:
// per slot, known by few rays; of flat surfaces that fill their voxel it becomes known by 16, by 4 where all around is
// lit alike.
std::vector<GlowPoint> sunPlaces(const TracedScene& scene, const SlotSampling& slots, const Links& links,
                                 std::span<Vec3> sunLux, uint64_t& rayCount);

// lx per slot that arrives from the patches, whose slots reflect `reflectedLx`: by samples of them and along links,
// which share it by multiple importance sampling.
std::vector<Vec3> lightFrom(const BrightPatches& patches, const RayScene& rays, const SlotSampling& slots,
                            const Links& links, std::span<const Vec3> reflectedLx, uint64_t& rayCount);

// Light that reaches slots from surfaces that no slot stands for: the inside of shelves, fronts beside one another in a
// voxel. Lights that fall straight on hidden places along links go on to these links' slots: lx per slot, of all lights
// together or, where layers are given, of each layer apart. What particles bring near lamps is left out. `field`: with
// what is known of where lights and the sky are seen.
std::vector<std::vector<Vec3>> lightOfHidden(const TracedScene& scene, const SlotSampling& slots, const Links& links,
                                             const RadianceField& field, const LightLayers* layers, uint64_t& rayCount);

}  // namespace roomlight
